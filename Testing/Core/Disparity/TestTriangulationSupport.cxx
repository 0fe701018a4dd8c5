// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/Outliers/TriangulationSupport.h"

#include "Support/RandomMaps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

using namespace freespace;

namespace
{

constexpr int GridSide = 15;

// A jittered grid of features on a plane across the view, and some of them at other depths.
DisparityMap GridMap(const std::vector<std::pair<int, double>>& depths = {})
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(-0.5, 0.5);
  DisparityMap map;
  map.camera = LookingAt({ 0, 0, 0 }, { 0, 0, 1 });
  for (int j = 0; j < GridSide; ++j)
  {
    for (int i = 0; i < GridSide; ++i)
    {
      map.imagePoints.emplace_back(10 + 5 * i + jitter(random), 5 + 5 * j + jitter(random));
      map.points.push_back(map.camera.Unproject(map.imagePoints.back(), 2));
      map.sourceView.push_back(0);
    }
  }
  for (const auto& [point, depth] : depths)
  {
    map.points[point] = map.camera.Unproject(map.imagePoints[point], depth);
  }
  for (int j = 0; j + 1 < GridSide; ++j)
  {
    for (int i = 0; i + 1 < GridSide; ++i)
    {
      const int a = j * GridSide + i, c = a + GridSide;
      map.triangles.push_back({ a, a + 1, c + 1 });
      map.triangles.push_back({ a, c + 1, c });
    }
  }
  return map;
}

std::vector<char> SupportOf(const DisparityMap& map, const OutlierOptions& options = {})
{
  return SupportedPoints(map, options, NeverCancelled);
}

std::vector<int> UnsupportedIn(const DisparityMap& map, const OutlierOptions& options = {})
{
  const std::vector<char> supported = SupportOf(map, options);
  std::vector<int> points;
  for (std::size_t i = 0; i < supported.size(); ++i)
  {
    if (!supported[i])
    {
      points.push_back(static_cast<int>(i));
    }
  }
  return points;
}

// The nearest points of all that at most two edges connect to one, by comparison with all of them.
std::vector<int> NearestInTwoRings(const DisparityMap& map, int point, std::size_t count)
{
  std::set<int> reached = { point };
  for (int ring = 0; ring < 2; ++ring)
  {
    std::set<int> next = reached;
    for (const auto& triangle : map.triangles)
    {
      if (reached.count(triangle[0]) || reached.count(triangle[1]) || reached.count(triangle[2]))
      {
        next.insert(triangle.begin(), triangle.end());
      }
    }
    reached = next;
  }
  reached.erase(point);
  std::vector<int> nearest(reached.begin(), reached.end());
  const auto distance = [&](int other)
  { return (map.imagePoints[other] - map.imagePoints[point]).squaredNorm(); };
  std::sort(
    nearest.begin(), nearest.end(), [&](int a, int b) { return distance(a) < distance(b); });
  nearest.resize(std::min(nearest.size(), count));
  return nearest;
}

}

TEST(TriangulationSupport, APlaneSupportsAllOfItself)
{
  EXPECT_TRUE(UnsupportedIn(GridMap()).empty());
}

TEST(TriangulationSupport, WhatLiesOffThePlaneAloneIsNotSupported)
{
  const int middle = GridSide * GridSide / 2;
  EXPECT_EQ(UnsupportedIn(GridMap({ { middle, 1.5 } })), (std::vector<int>{ middle }));
  EXPECT_EQ(UnsupportedIn(GridMap({ { middle, 3 } })), (std::vector<int>{ middle }));
  // As far as the noise goes, it is on the plane.
  EXPECT_TRUE(UnsupportedIn(GridMap({ { middle, 2 * (1 + 5e-4) } })).empty());
}

// Two that agree support each other where one is asked for; where two are, only three do.
TEST(TriangulationSupport, AsManyAsAskedForMustAgree)
{
  const int a = GridSide * (GridSide / 2) + GridSide / 2, b = a + 1,
            c = a + GridSide + 1; // a triangle
  OutlierOptions one, two;
  one.support = 1;
  two.support = 2;
  one.nearest = two.nearest = 8; // all around a point of the grid
  const DisparityMap pair = GridMap({ { a, 1.5 }, { b, 1.5 } });
  EXPECT_TRUE(UnsupportedIn(pair, one).empty());
  EXPECT_EQ(UnsupportedIn(pair, two), (std::vector<int>{ a, b }));
  EXPECT_TRUE(UnsupportedIn(GridMap({ { a, 1.5 }, { b, 1.5 }, { c, 1.5 } }), two).empty());
}

TEST(TriangulationSupport, WithoutTheTestAllWithNeighboursPass)
{
  OutlierOptions options;
  options.support = 0;
  EXPECT_TRUE(UnsupportedIn(GridMap({ { 7, 0.5 } }), options).empty());
}

TEST(TriangulationSupport, TooFewNeighboursAreNoSupport)
{
  DisparityMap map = GridMap();
  map.triangles = { { 0, 1, GridSide } };
  const std::vector<char> supported = SupportOf(map);
  EXPECT_EQ(std::count(supported.begin(), supported.end(), 1), 3) << "the corners of the triangle";
  OutlierOptions three;
  three.support = 3;
  EXPECT_EQ(UnsupportedIn(map, three).size(), map.points.size()) << "each has two";
}

// Depths at random: a point is supported exactly when its second most similar neighbour differs by no more than the
// threshold, which the definition gives.
TEST(TriangulationSupport, AgreesWithTheDefinition)
{
  std::mt19937 random(8);
  std::lognormal_distribution<double> factor(0, 0.01);
  std::uniform_real_distribution<double> shift(0, 0.15);
  std::vector<std::pair<int, double>> depths;
  for (int i = 0; i < GridSide * GridSide; ++i)
  {
    depths.emplace_back(i, 2 * factor(random) * (random() % 5 == 0 ? 1 + shift(random) : 1.0));
  }
  const DisparityMap map = GridMap(depths);
  OutlierOptions options;
  const double slope = std::tan(options.steepestAngle * M_PI / 180) / map.camera.FocalLength();
  std::vector<double> lack;
  for (int i = 0; i < GridSide * GridSide; ++i)
  {
    std::vector<double> differences;
    for (const int other : NearestInTwoRings(map, i, options.nearest))
    {
      const double own = 1 / map.camera.Depth(map.points[i]);
      const double its = 1 / map.camera.Depth(map.points[other]);
      const double difference = std::abs(own - its) / std::max(own, its);
      const double distance = (map.imagePoints[i] - map.imagePoints[other]).norm();
      const bool canJoin = difference <= Agreement * options.noise + slope * distance;
      differences.push_back(canJoin ? difference : HUGE_VAL);
    }
    std::sort(differences.begin(), differences.end());
    lack.push_back(differences[options.support - 1]);
  }
  std::vector<double> sorted = lack;
  std::sort(sorted.begin(), sorted.end());
  const double median = sorted[sorted.size() / 2];
  const double most = std::max(10 * options.noise, 5 * median);
  std::vector<int> expected;
  for (int i = 0; i < GridSide * GridSide; ++i)
  {
    if (!(lack[i] <= most))
    {
      expected.push_back(i);
    }
  }
  EXPECT_GE(expected.size(), 5u);
  EXPECT_LE(expected.size(), 60u);
  EXPECT_EQ(UnsupportedIn(map, options), expected);
}
