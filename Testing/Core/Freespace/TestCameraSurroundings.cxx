// SPDX-License-Identifier: BSD-3-Clause
#include "Common/Error.h"
#include "Freespace/CameraSurroundings.h"
#include "Freespace/FreespaceUnion.h"

#include "Support/PlainSettings.h"
#include <gtest/gtest.h>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

// A camera at the given place that sees a wall ahead of it at z = 2; the wall behind, at z = -2, is known by
// features that are no part of its triangles.
DisparityMap BetweenWalls(const Vector3d& center)
{
  DisparityMap map;
  map.name = "between";
  map.camera.K << 100, 0, 50, 0, 100, 50, 0, 0, 1;
  map.camera.width = map.camera.height = 100;
  map.camera.t = -center;
  for (const double z : { 2.0, -2.0 })
  {
    for (int i = 0; i < 121; ++i)
    {
      map.points.push_back({ 0.2 * (i % 11) - 1, 0.2 * (i / 11) - 1, z });
      map.imagePoints.push_back(map.camera.Project(map.points.back()));
      map.sourceView.push_back(0);
    }
  }
  map.triangles = { { 0, 10, 120 }, { 0, 120, 110 } };
  return map;
}

FreespaceUnionOptions With(double surroundings)
{
  auto options = Plain(FreespaceUnionOptions());
  options.surroundings = surroundings;
  return options;
}

}

TEST(CameraSurroundings, OfACameraInsideTheHullAreFree)
{
  const Vector3d center(0.1, -0.1, 0.2);
  const std::vector<DisparityMap> maps = { BetweenWalls(center) };
  const FreespaceUnion without(maps, With(0)), phi(maps, With(0.5));
  // The nearest features are 1.8 away.
  for (const Vector3d& way : { Vector3d(1, 0, 0), Vector3d(0, -1, 0), Vector3d(0, 0, -1) })
  {
    EXPECT_FALSE(without.IsFree(center + 0.4 * way));
    EXPECT_TRUE(phi.IsFree(center + 0.4 * way));
    EXPECT_GT(phi.Value(center + 0.4 * way), 0);
    EXPECT_FALSE(phi.IsFree(center + 0.7 * way)) << "farther than the cube reaches";
  }
  EXPECT_EQ(phi.NumberOfViews(), 1u);
}

TEST(CameraSurroundings, AreAWallOfTheCamerasView)
{
  const Vector3d center(0, 0, 0);
  const std::vector<DisparityMap> maps = { BetweenWalls(center) };
  const FreespaceUnion phi(maps, With(0.5));
  double place = 0;
  SurfaceLabel label;
  ASSERT_TRUE(phi.Crossing({ 0, 0, -1 }, { 0, 0, -0.1 }, phi.Root(), place, label));
  EXPECT_NEAR(1 - 0.9 * place, 0.5 * 2 / std::sqrt(3.0), 0.05);
  EXPECT_EQ(label.view, 0);
  EXPECT_EQ(label.kind, SurfaceKind::Wall);
}

TEST(CameraSurroundings, AreFreeHoweverManyViewsMustAgree)
{
  const std::vector<DisparityMap> maps(3, BetweenWalls({ 0, 0, 0 }));
  auto options = Plain(FreespaceUnionOptions());
  options.minimumViews = 3;
  EXPECT_TRUE(FreespaceUnion(maps, options).IsFree({ 0, 0, -0.2 }));
}

TEST(CameraSurroundings, ThereAreNoneOutsideTheHullOrWithoutFeatures)
{
  const std::vector<DisparityMap> maps = { BetweenWalls({ 0, 0, -5 }) };
  const FreespaceUnion phi(maps, {});
  EXPECT_FALSE(phi.IsFree({ 0.9, 0.9, -1.5 }));
  EXPECT_TRUE(CameraSurroundings({}, RegionHull(), 0.5).empty());
  EXPECT_THROW(With(1).Check(), Error);
}
