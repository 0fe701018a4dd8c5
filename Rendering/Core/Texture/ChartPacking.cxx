// SPDX-License-Identifier: BSD-3-Clause
#include "Texture/ChartPacking.h"

#include "Common/Error.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace freespace
{

bool PackCharts(
  std::vector<Chart>& charts, double texel, const TextureAtlasOptions& options, TextureAtlas& atlas)
{
  std::vector<int> order(charts.size());
  std::iota(order.begin(), order.end(), 0);
  double area = 0;
  int widest = 1;
  for (Chart& chart : charts)
  {
    const Eigen::Vector2d size = (chart.high - chart.low) / texel;
    if (!(size.maxCoeff() < options.largest))
    {
      return false;
    }
    chart.width = static_cast<int>(std::ceil(size.x())) + 1 + 2 * options.gutter;
    chart.height = static_cast<int>(std::ceil(size.y())) + 1 + 2 * options.gutter;
    area += double(chart.width) * chart.height;
    widest = std::max(widest, chart.width);
  }
  std::stable_sort(
    order.begin(), order.end(), [&](int a, int b) { return charts[a].height > charts[b].height; });
  const int square = static_cast<int>(std::min(1e6, std::ceil(std::sqrt(1.05 * area))));
  atlas.width = (std::max(widest, square) + 3) / 4 * 4;
  int column = 0;
  int row = 1; // the first row is for unseen triangles
  int shelf = 0;
  for (const int i : order)
  {
    Chart& chart = charts[i];
    if (column + chart.width > atlas.width)
    {
      row += shelf;
      column = 0;
      shelf = 0;
    }
    chart.column = column;
    chart.row = row;
    column += chart.width;
    shelf = std::max(shelf, chart.height);
  }
  atlas.height = (row + shelf + 3) / 4 * 4;
  return atlas.width <= options.largest && atlas.height <= options.largest;
}

void CheckChartsFit(
  std::vector<Chart>& charts, const TextureAtlasOptions& options, TextureAtlas& atlas)
{
  double extent = 0;
  for (const Chart& chart : charts)
  {
    extent = std::max(extent, (chart.high - chart.low).maxCoeff());
  }
  if (!charts.empty() && !PackCharts(charts, extent > 0 ? 2 * extent : 1.0, options, atlas))
  {
    throw Error("The surface falls into " + std::to_string(charts.size()) +
      " charts, which no texture with a longest side of " + std::to_string(options.largest) +
      " holds.");
  }
}

}
