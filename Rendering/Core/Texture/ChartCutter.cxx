// SPDX-License-Identifier: BSD-3-Clause
#include "Texture/ChartCutter.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <numeric>
#include <queue>

namespace freespace
{

namespace
{

constexpr double LeastChartCosine = 0.4; // between a chart's direction and its triangles' normals
constexpr double LongestSide = 65536;    // of a triangle in texels; no texture holds a longer one

std::uint64_t Cell(int column, int row)
{
  return std::uint64_t(std::uint32_t(column)) << 32 | std::uint32_t(row);
}

}

ChartCutter::ChartCutter(
  const SurfaceGeometry& surface, const std::vector<char>& seenTriangles, double texelSide)
  : Surface(surface)
  , Texel(texelSide)
  , Free(seenTriangles)
{
}

std::vector<Chart> ChartCutter::Cut()
{
  std::vector<int> seeds(this->Free.size());
  std::iota(seeds.begin(), seeds.end(), 0);
  const auto worth = [&](int t)
  { return this->Surface.areas[t] * this->Surface.normals[t].cwiseAbs().maxCoeff(); };
  std::stable_sort(seeds.begin(), seeds.end(), [&](int a, int b) { return worth(a) > worth(b); });
  std::vector<Chart> charts;
  for (const int seed : seeds)
  {
    if (this->Free[seed] && this->Surface.areas[seed] > 0)
    {
      charts.push_back(this->Grow(seed));
    }
  }
  return charts;
}

Chart ChartCutter::Grow(int seed)
{
  Chart chart;
  const Eigen::Vector3d& normal = this->Surface.normals[seed];
  normal.cwiseAbs().maxCoeff(&chart.axis);
  chart.sign = normal[chart.axis] < 0 ? -1 : 1;
  this->Heights.clear();
  std::queue<int> waiting;
  waiting.push(seed);
  while (!waiting.empty())
  {
    const int triangle = waiting.front();
    waiting.pop();
    if (!this->Free[triangle] || !this->Fits(chart, triangle))
    {
      continue;
    }
    this->Free[triangle] = 0;
    chart.triangles.push_back(triangle);
    for (int corner = 0; corner < 3; ++corner)
    {
      const Eigen::Vector2d flat = chart.Flat(this->Surface.Corner(triangle, corner));
      chart.low = chart.low.cwiseMin(flat);
      chart.high = chart.high.cwiseMax(flat);
      const int neighbor = this->Surface.neighbors[triangle][corner];
      if (neighbor >= 0 && this->Free[neighbor])
      {
        waiting.push(neighbor);
      }
    }
  }
  return chart;
}

// Whether the triangle faces the direction of the chart and does not overlap another part of it.
bool ChartCutter::Fits(const Chart& chart, int triangle)
{
  const Eigen::Vector3d& normal = this->Surface.normals[triangle];
  if (!(chart.sign * normal[chart.axis] > LeastChartCosine) && !chart.triangles.empty())
  {
    return false;
  }
  std::array<Eigen::Vector2d, 3> flat;
  for (int i = 0; i < 3; ++i)
  {
    flat[i] = chart.Flat(this->Surface.Corner(triangle, i)) / this->Texel;
  }
  for (int i = 0; i < 3; ++i)
  {
    if (!((flat[i] - flat[(i + 1) % 3]).cwiseAbs().maxCoeff() < LongestSide) ||
      !(flat[i].cwiseAbs().maxCoeff() < INT_MAX / 2.0))
    {
      return chart.triangles.empty(); // by itself, until texels are larger
    }
  }
  const float height = static_cast<float>(this->Surface.Middle(triangle)[chart.axis]);
  const double extent = (flat[0] - flat[1]).norm() + (flat[0] - flat[2]).norm();
  const float tolerance = static_cast<float>(this->Texel * (8 + 3 * extent));
  bool fits = true;
  ForEachCell(flat,
    [&](int column, int row)
    {
      const auto at = this->Heights.find(Cell(column, row));
      fits = fits && (at == this->Heights.end() || std::abs(at->second - height) < tolerance);
    });
  if (fits)
  {
    ForEachCell(
      flat, [&](int column, int row) { this->Heights.emplace(Cell(column, row), height); });
  }
  return fits;
}

}
