// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/FeatureGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

std::vector<Vector3d> RandomPoints(unsigned int seed, int count, double size)
{
  std::mt19937 engine(seed);
  std::vector<Vector3d> points;
  for (int i = 0; i < 3 * count; ++i)
  {
    points.resize(i / 3 + 1);
    points.back()[i % 3] = size * engine() / 4294967296.0;
  }
  return points;
}

}

TEST(FeatureGrid, AgreesWithBruteForce)
{
  for (const double reach : { 0.001, 0.05, 0.3, 2.0 })
  {
    for (const Vector3d& offset : { Vector3d(0, 0, 0), Vector3d(-7, 1e5, 3) })
    {
      std::vector<Vector3d> points = RandomPoints(1, 300, 1);
      std::vector<Vector3d> places = RandomPoints(2, 500, 1.4);
      places.insert(places.end(), points.begin(), points.begin() + 10);
      for (Vector3d& point : points)
      {
        point += offset;
      }
      const FeatureGrid grid(points, reach);
      for (const Vector3d& place : places)
      {
        const Vector3d there = place + offset - Vector3d::Constant(0.2);
        const bool isNear = std::any_of(points.begin(), points.end(),
          [&](const Vector3d& point) { return (point - there).norm() <= reach; });
        EXPECT_EQ(grid.IsNear(there), isNear) << reach << " " << there.transpose();
      }
    }
  }
}

TEST(FeatureGrid, TakesFarPlacesAndNoPoints)
{
  const FeatureGrid none({}, 1);
  EXPECT_FALSE(none.IsNear({ 0, 0, 0 }));
  const FeatureGrid grid({ { 0, 0, 0 }, { NAN, 0, 0 }, { 1e9, 0, 0 } }, 0.5);
  EXPECT_TRUE(grid.IsNear({ 0.4, 0, 0 }));
  EXPECT_TRUE(grid.IsNear({ 1e9, 0.4, 0 }));
  EXPECT_FALSE(grid.IsNear({ -1e12, 1e300, 0 }));
  EXPECT_FALSE(grid.IsNear({ NAN, 0, 0 }));
  const FeatureGrid exact({ { 1, 2, 3 } }, 0);
  EXPECT_TRUE(exact.IsNear({ 1, 2, 3 }));
  EXPECT_FALSE(exact.IsNear({ 1, 2, 3.001 }));
}
