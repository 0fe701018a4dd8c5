// SPDX-License-Identifier: BSD-3-Clause
// Which triangles are bridges, by the formula of a slanted strip, and the mask against all triangles.
#include "Disparity/Background/BridgedMap.h"

#include "Support/RandomMaps.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace freespace;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

Camera CameraAtOrigin()
{
  Camera camera;
  camera.K << 100, 0, 50, 0, 100, 50, 0, 0, 1;
  camera.width = camera.height = 100;
  return camera;
}

// Two triangles in the middle of the image that rise from one depth on the left to another on the right.
DisparityMap Strip(double left, double right)
{
  DisparityMap map;
  map.camera = CameraAtOrigin();
  for (const auto& [pixel, depth] :
    { std::pair(Vector2d(49, 49), left), std::pair(Vector2d(51, 49), right),
      std::pair(Vector2d(51, 51), right), std::pair(Vector2d(49, 51), left) })
  {
    map.imagePoints.push_back(pixel);
    map.points.push_back(map.camera.Unproject(pixel, depth));
    map.sourceView.push_back(0);
  }
  map.triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  return map;
}

// Under which some of the triangles of random maps are bridges, and some are not.
BackgroundOptions HalfGrazing()
{
  BackgroundOptions options;
  options.grazingAngle = 30;
  return options;
}

int CountBridges(const BridgedMap& bridged)
{
  return static_cast<int>(std::count(bridged.isBridge.begin(), bridged.isBridge.end(), 1));
}

int CountBridges(const DisparityMap& map, const BackgroundOptions& options = {})
{
  return CountBridges(BridgedMap(map, options, NeverCancelled));
}

}

TEST(BridgedMap, OfNoTrianglesHasNoBridges)
{
  const DisparityMap map;
  const BridgedMap bridged(map, BackgroundOptions(), NeverCancelled);
  EXPECT_TRUE(bridged.isBridge.empty());
  EXPECT_TRUE(bridged.disparity.empty());
}

TEST(BridgedMap, CanBeCancelled)
{
  const CancellationFlag stop{ true };
  EXPECT_THROW(BridgedMap(Strip(1, 2), BackgroundOptions(), stop), Aborted);
}

// Two pixels wide at a focal length of 100: a strip from depth 1 to 1 + d meets the line of sight at
// atan(d / 0.02), about.
TEST(BridgedMap, GrazingIncidenceMakesABridge)
{
  for (const double angle : { 20.0, 45.0, 60.0, 75.0, 85.0 })
  {
    const double depth = 1 / (1 - 0.02 * std::tan(angle * M_PI / 180));
    const DisparityMap map = Strip(1, depth);
    const Vector3d normal =
      (map.points[1] - map.points[0]).cross(map.points[2] - map.points[0]).normalized();
    const Vector3d sight = (map.points[0] + map.points[1] + map.points[2]).normalized();
    const double incidence = std::acos(std::abs(normal.dot(sight))) * 180 / M_PI;
    for (const double limit : { 10.0, 30.0, 50.0, 70.0, 80.0 })
    {
      BackgroundOptions options;
      options.grazingAngle = limit;
      EXPECT_EQ(CountBridges(map, options), incidence > limit ? 2 : 0)
        << incidence << " against " << limit;
    }
  }
}

TEST(BridgedMap, AJumpWithinTheNoiseIsNone)
{
  BackgroundOptions options;
  options.grazingAngle = 0; // any incidence will do
  options.noise = 0.01;     // a jump is ten times as deep
  EXPECT_EQ(CountBridges(Strip(1, 1.09), options), 0);
  EXPECT_EQ(CountBridges(Strip(1, 1.11), options), 2);
  EXPECT_EQ(CountBridges(Strip(1.11, 1), options), 2) << "whichever side is near";
}

TEST(BridgedMap, PointsKnowTheirDisparityAndTheirSoundTriangles)
{
  int bridges = 0, sound = 0;
  for (const DisparityMap& map : RandomMaps(5, 20))
  {
    const BridgedMap bridged(map, HalfGrazing(), NeverCancelled);
    bridges += CountBridges(bridged);
    for (std::size_t point = 0; point < map.points.size(); ++point)
    {
      EXPECT_NEAR(bridged.disparity[point] * map.camera.Depth(map.points[point]), 1, 1e-12);
      std::vector<int> expected;
      for (std::size_t t = 0; t < map.triangles.size(); ++t)
      {
        const auto& corners = map.triangles[t];
        if (!bridged.isBridge[t] &&
          std::find(corners.begin(), corners.end(), static_cast<int>(point)) != corners.end())
        {
          expected.push_back(static_cast<int>(t));
        }
      }
      const auto list = bridged.sound[point];
      EXPECT_EQ(std::vector<int>(list.begin(), list.end()), expected);
      sound += static_cast<int>(expected.size());
    }
  }
  EXPECT_GT(bridges, 50);
  EXPECT_GT(sound, 50);
}

TEST(BridgeMask, HoldsEveryPixelOfABridgeAndFewBesideThem)
{
  std::mt19937 random(13);
  std::uniform_real_distribution<double> unit(0, 1);
  int beside = 0, rejected = 0;
  for (const DisparityMap& map : RandomMaps(13, 20))
  {
    const BridgedMap bridged(map, HalfGrazing(), NeverCancelled);
    const BridgeMask mask(bridged);
    std::vector<Eigen::AlignedBox2d> boxes; // of the bridges
    for (std::size_t t = 0; t < map.triangles.size(); ++t)
    {
      const auto& [a, b, c] = map.triangles[t];
      if (!bridged.isBridge[t])
      {
        continue;
      }
      boxes.emplace_back(map.imagePoints[a]);
      boxes.back().extend(map.imagePoints[b]).extend(map.imagePoints[c]);
      for (int i = 0; i < 20; ++i)
      {
        Eigen::Array3d weights(unit(random), unit(random), unit(random));
        weights /= weights.sum();
        EXPECT_TRUE(mask.MayHold(weights[0] * map.imagePoints[a] + weights[1] * map.imagePoints[b] +
          weights[2] * map.imagePoints[c]));
      }
    }
    for (int i = 0; i < 500; ++i)
    {
      const Vector2d pixel(140 * unit(random) - 20, 120 * unit(random) - 20);
      // Tiles are less than half a pixel wide: the image has 100 x 80.
      const bool isFar = std::all_of(boxes.begin(), boxes.end(),
        [&](const Eigen::AlignedBox2d& box) { return box.exteriorDistance(pixel) > 0.7; });
      beside += isFar;
      rejected += isFar && !mask.MayHold(pixel);
    }
  }
  EXPECT_GT(beside, 500);
  EXPECT_EQ(rejected, beside);
}

TEST(BridgeMask, OfAMapWithoutTrianglesHoldsNothing)
{
  const DisparityMap map;
  const BridgedMap bridged(map, HalfGrazing(), NeverCancelled);
  EXPECT_FALSE(BridgeMask(bridged).MayHold({ 0, 0 }));
}
