// SPDX-License-Identifier: BSD-3-Clause
#include "Texture/ChartCutter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

using namespace freespace;

namespace
{

// A ball of rings of triangles.
TriangleMesh BallMesh(int rings = 24)
{
  TriangleMesh mesh;
  const int around = 2 * rings;
  for (int j = 0; j <= rings; ++j)
  {
    for (int i = 0; i < around; ++i)
    {
      const double down = M_PI * j / rings, turn = 2 * M_PI * i / around;
      mesh.points.emplace_back(
        std::sin(down) * std::cos(turn), std::sin(down) * std::sin(turn), std::cos(down));
    }
  }
  for (int j = 0; j < rings; ++j)
  {
    for (int i = 0; i < around; ++i)
    {
      const int a = j * around + i, b = j * around + (i + 1) % around;
      mesh.triangles.push_back({ a, a + around, b + around });
      mesh.triangles.push_back({ a, b + around, b });
    }
  }
  return mesh;
}

TriangleMesh CubeMesh()
{
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
  {
    mesh.points.emplace_back(i & 1, i >> 1 & 1, i >> 2);
  }
  mesh.triangles = { { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }, { 0, 1, 5 }, { 0, 5, 4 },
    { 2, 6, 7 }, { 2, 7, 3 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 } };
  return mesh;
}

std::vector<Chart> Cut(const TriangleMesh& mesh, double texel, std::vector<char> seen = {})
{
  const SurfaceGeometry geometry(mesh);
  seen.resize(mesh.triangles.size(), 1);
  return ChartCutter(geometry, seen, texel).Cut();
}

}

TEST(ChartCutter, ACubeHasAChartForEachFace)
{
  const TriangleMesh cube = CubeMesh();
  const std::vector<Chart> charts = Cut(cube, 0.1);
  ASSERT_EQ(charts.size(), 6u);
  std::set<std::pair<int, double>> ways;
  for (const Chart& chart : charts)
  {
    EXPECT_EQ(chart.triangles.size(), 2u);
    EXPECT_LT((chart.high - chart.low - Eigen::Vector2d(1, 1)).norm(), 1e-12);
    ways.insert({ chart.axis, chart.sign });
  }
  EXPECT_EQ(ways.size(), 6u);
}

TEST(ChartCutter, EachSeenTriangleIsInOneChartThatFacesIt)
{
  const TriangleMesh ball = BallMesh();
  const SurfaceGeometry geometry(ball);
  std::vector<char> seen(ball.triangles.size());
  for (std::size_t t = 0; t < seen.size(); ++t)
  {
    seen[t] = geometry.Middle(static_cast<int>(t)).x() > -0.3;
  }
  const std::vector<Chart> charts = Cut(ball, 0.02, seen);
  std::vector<int> charted(seen.size(), 0);
  for (const Chart& chart : charts)
  {
    for (const int t : chart.triangles)
    {
      ++charted[t];
      if (t != chart.triangles.front())
      {
        const double cosine = chart.sign * geometry.normals[t][chart.axis];
        EXPECT_GT(cosine, std::cos(66.5 * M_PI / 180));
      }
      for (int corner = 0; corner < 3; ++corner)
      {
        const Eigen::Vector2d flat = chart.Flat(geometry.Corner(t, corner));
        EXPECT_TRUE((flat.array() >= chart.low.array()).all());
        EXPECT_TRUE((flat.array() <= chart.high.array()).all());
      }
    }
  }
  for (std::size_t t = 0; t < seen.size(); ++t)
  {
    EXPECT_EQ(charted[t], seen[t] && geometry.areas[t] > 0) << t;
  }
  EXPECT_LE(charts.size(), 12u) << "a ball does not fall into crumbs";
}

// Two parallel layers that a steep side joins would cover the same texels.
TEST(ChartCutter, LayersAboveEachOtherAreApart)
{
  // A band that winds twice around an axis along y, like a spring, so that its turns overlap from x and z.
  TriangleMesh spring;
  constexpr int steps = 96;
  for (int i = 0; i <= 2 * steps; ++i)
  {
    const double turn = 2 * M_PI * i / steps, radius = 1 + 0.5 * i / steps;
    spring.points.emplace_back(radius * std::cos(turn), 0, radius * std::sin(turn));
    spring.points.emplace_back(radius * std::cos(turn), 1, radius * std::sin(turn));
  }
  for (int i = 0; i < 2 * steps; ++i)
  {
    const int a = 2 * i;
    spring.triangles.push_back({ a, a + 1, a + 3 });
    spring.triangles.push_back({ a, a + 3, a + 2 });
  }
  const double texel = 0.01;
  const SurfaceGeometry geometry(spring);
  std::size_t charted = 0;
  for (const Chart& chart : Cut(spring, texel))
  {
    charted += chart.triangles.size();
    std::map<std::pair<int, int>, std::pair<double, double>> heights; // of each texel's triangles
    for (const int t : chart.triangles)
    {
      std::array<Eigen::Vector2d, 3> flat;
      for (int i = 0; i < 3; ++i)
      {
        flat[i] = chart.Flat(geometry.Corner(t, i)) / texel;
      }
      ForEachCell(flat,
        [&](int column, int row)
        {
          const double height = geometry.Middle(t)[chart.axis];
          auto& range = heights.emplace(std::make_pair(column, row), std::make_pair(height, height))
                          .first->second;
          range = { std::min(range.first, height), std::max(range.second, height) };
        });
    }
    for (const auto& [cell, range] : heights)
    {
      ASSERT_LT(range.second - range.first, 0.45) << "the turns are 0.5 apart";
    }
  }
  EXPECT_EQ(charted, spring.triangles.size());
}

TEST(ChartCutter, NothingSeenHasNoChart)
{
  const TriangleMesh cube = CubeMesh();
  EXPECT_TRUE(Cut(cube, 0.1, std::vector<char>(12, 0)).empty());
  EXPECT_TRUE(Cut(TriangleMesh(), 0.1).empty());
}
