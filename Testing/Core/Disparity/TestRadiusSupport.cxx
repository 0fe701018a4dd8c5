// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/Outliers/RadiusSupport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace freespace;

namespace
{

View MakeUnitView()
{
  View view;
  view.camera.K << 100, 0, 50, 0, 100, 40, 0, 0, 1;
  view.camera.width = 100;
  view.camera.height = 80;
  return view;
}

void AddFeatureAtDepth(View& view, const Eigen::Vector2d& pixel, double depth)
{
  view.points.push_back(view.camera.Unproject(pixel, depth));
  view.imagePoints.push_back(pixel);
}

View RandomView(unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> x(-10, 110), y(-10, 90), depth(1, 1.05);
  View view = MakeUnitView();
  for (int i = 0; i < 400; ++i)
  {
    AddFeatureAtDepth(view, { x(random), y(random) }, depth(random));
  }
  return view;
}

std::vector<int> BruteForceSupport(const View& view, double radius, double tolerance)
{
  std::vector<int> support(view.points.size(), 0);
  for (std::size_t i = 0; i < support.size(); ++i)
  {
    for (std::size_t j = 0; j < support.size(); ++j)
    {
      const double a = 1 / view.camera.Depth(view.points[i]);
      const double b = 1 / view.camera.Depth(view.points[j]);
      support[i] += i != j && (view.imagePoints[i] - view.imagePoints[j]).norm() <= radius &&
        std::abs(a - b) <= tolerance * std::max(a, b);
    }
  }
  return support;
}

}

TEST(RadiusSupport, AgreesWithBruteForce)
{
  for (unsigned int seed = 0; seed < 20; ++seed)
  {
    const View view = RandomView(seed);
    EXPECT_EQ(CountSupport(view, 1.0 + seed, 0.01), BruteForceSupport(view, 1.0 + seed, 0.01))
      << "seed " << seed;
  }
}

TEST(RadiusSupport, OutlierHasNone)
{
  View view = MakeUnitView();
  for (int i = 0; i < 5; ++i)
  {
    AddFeatureAtDepth(view, { 50.0 + i, 40.0 }, 1.0);
  }
  AddFeatureAtDepth(view, { 52.0, 40.5 }, 0.5);
  const std::vector<int> support = CountSupport(view, 4, 0.01);
  EXPECT_EQ(support, (std::vector<int>{ 4, 4, 4, 4, 4, 0 }));
}

TEST(RadiusSupport, EmptyView)
{
  EXPECT_TRUE(CountSupport(MakeUnitView(), 4, 0.01).empty());
}

TEST(RadiusSupport, NotANumberAndBehindTheCameraAreUnusable)
{
  View view = MakeUnitView();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  AddFeatureAtDepth(view, { 50, 40 }, 1.0);
  AddFeatureAtDepth(view, { 51, 40 }, 1.0);
  view.points.push_back({ nan, 0, 1 });
  view.imagePoints.push_back({ 50, 40 });
  AddFeatureAtDepth(view, { 50, 40 }, -1.0);
  view.points.push_back({ 0, 0, 1 });
  view.imagePoints.push_back({ nan, nan });
  EXPECT_EQ(CountSupport(view, 4, 0.01), (std::vector<int>{ 1, 1, -1, -1, -1 }));
}

TEST(RadiusSupport, DuplicatesSupportEachOther)
{
  View view = MakeUnitView();
  AddFeatureAtDepth(view, { 50, 40 }, 1.0);
  AddFeatureAtDepth(view, { 50, 40 }, 1.0);
  EXPECT_EQ(CountSupport(view, 4, 0.01), (std::vector<int>{ 1, 1 }));
}

// Each with each would be 10^11 comparisons.
TEST(RadiusSupport, CoincidentByTheHundredThousand)
{
  constexpr int count = 300000;
  View view = MakeUnitView();
  for (int i = 0; i < count; ++i)
  {
    AddFeatureAtDepth(view, { 50, 40 }, i < count / 2 ? 1.0 : 3.0);
  }
  AddFeatureAtDepth(view, { -500, 40 }, 1.0);
  const std::vector<int> support = CountSupport(view, 4, 0.01);
  EXPECT_EQ(support.front(), count / 2 - 1);
  EXPECT_EQ(support[count - 1], count / 2 - 1);
  EXPECT_EQ(support.back(), 0);
}

TEST(RadiusSupport, MeanSpacingOfAGrid)
{
  // A grid of 10 x 8 features 10 pixels apart covers 90 x 70 pixels: a mean spacing of 8.87.
  View view = MakeUnitView();
  for (int i = 0; i < 80; ++i)
  {
    AddFeatureAtDepth(view, { 5.0 + i % 10 * 10, 5.0 + i / 10 * 10 }, 2);
  }
  const double spacing = MeanSpacing(view);
  EXPECT_DOUBLE_EQ(spacing, std::sqrt(90.0 * 70 / 80));
  const std::vector<int> support = CountSupport(view, 1.2 * spacing, 0.01); // the four next to it
  EXPECT_EQ(support[0], 2);
  EXPECT_EQ(support[1], 3);
  EXPECT_EQ(support[11], 4);
  EXPECT_EQ(CountSupport(view, 1.65 * spacing, 0.01)[11], 8); // also the diagonal ones
}

TEST(RadiusSupport, MeanSpacingOfCoincidentOrNoFeatures)
{
  View view = MakeUnitView();
  EXPECT_EQ(MeanSpacing(view), 0);
  AddFeatureAtDepth(view, { 5, 5 }, 2);
  AddFeatureAtDepth(view, { 5, 5 }, 2);
  EXPECT_EQ(MeanSpacing(view), 0);
}
