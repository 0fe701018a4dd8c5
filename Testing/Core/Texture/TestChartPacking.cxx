// SPDX-License-Identifier: BSD-3-Clause
#include "Texture/ChartPacking.h"

#include "Common/Error.h"

#include <gtest/gtest.h>

#include <random>

using namespace freespace;

namespace
{

Chart ChartOf(double width, double height)
{
  Chart chart;
  chart.low = { 3, -2 };
  chart.high = chart.low + Eigen::Vector2d(width, height);
  return chart;
}

}

TEST(ChartPacking, SizesAreThoseOfTheChartsInTexels)
{
  std::vector<Chart> charts = { ChartOf(10, 4) };
  TextureAtlas atlas;
  TextureAtlasOptions options;
  options.gutter = 2;
  ASSERT_TRUE(PackCharts(charts, 0.5, options, atlas));
  EXPECT_EQ(charts[0].width, 20 + 1 + 4);
  EXPECT_EQ(charts[0].height, 8 + 1 + 4);
  EXPECT_EQ(charts[0].column, 0);
  EXPECT_EQ(charts[0].row, 1) << "the first row is for unseen triangles";
  EXPECT_EQ(atlas.width, 28) << "the next multiple of 4";
  EXPECT_EQ(atlas.height, 16);
}

TEST(ChartPacking, ChartsDoNotOverlapAndLieInTheAtlas)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> side(0, 30);
  for (int trial = 0; trial < 50; ++trial)
  {
    std::vector<Chart> charts;
    for (int i = 0; i <= 3 * trial; ++i)
    {
      charts.push_back(ChartOf(side(random), side(random)));
    }
    TextureAtlas atlas;
    const TextureAtlasOptions options;
    ASSERT_TRUE(PackCharts(charts, 1, options, atlas));
    std::vector<char> taken(static_cast<std::size_t>(atlas.width) * atlas.height, 0);
    double area = 0;
    for (const Chart& chart : charts)
    {
      ASSERT_GE(chart.column, 0);
      ASSERT_GE(chart.row, 1);
      ASSERT_LE(chart.column + chart.width, atlas.width);
      ASSERT_LE(chart.row + chart.height, atlas.height);
      area += double(chart.width) * chart.height;
      for (int y = chart.row; y < chart.row + chart.height; ++y)
      {
        for (int x = chart.column; x < chart.column + chart.width; ++x)
        {
          char& texel = taken[static_cast<std::size_t>(y) * atlas.width + x];
          ASSERT_EQ(texel, 0) << "two charts at " << x << ", " << y;
          texel = 1;
        }
      }
    }
    if (charts.size() >= 50)
    {
      EXPECT_GT(area, 0.7 * taken.size()) << "of many charts, most of the atlas is filled";
    }
  }
}

TEST(ChartPacking, RefusesWhatNeverFits)
{
  TextureAtlas atlas;
  TextureAtlasOptions options;
  options.largest = 64;
  std::vector<Chart> wide = { ChartOf(100, 1) };
  EXPECT_FALSE(PackCharts(wide, 1, options, atlas));
  EXPECT_TRUE(PackCharts(wide, 2, options, atlas)) << "larger texels";
  EXPECT_NO_THROW(CheckChartsFit(wide, options, atlas));
  std::vector<Chart> many(1000, ChartOf(0, 0)); // 5 x 5 texels each, however large these are
  EXPECT_THROW(CheckChartsFit(many, options, atlas), Error);
  std::vector<Chart> none;
  EXPECT_NO_THROW(CheckChartsFit(none, options, atlas));
  EXPECT_TRUE(PackCharts(none, 1, options, atlas));
}
