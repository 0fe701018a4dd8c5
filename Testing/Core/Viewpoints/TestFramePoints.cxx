// SPDX-License-Identifier: BSD-3-Clause
#include "Viewpoints/FramePoints.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

using namespace freespace;

namespace
{

Camera AnyCamera()
{
  Camera camera;
  camera.K << 700, 0, 350, 0, 650, 200, 0, 0, 1; // not centred
  camera.width = 640;
  camera.height = 480;
  camera.R = Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  camera.t = { 5, -3, 100 };
  return camera;
}

std::vector<Eigen::Vector3d> Cloud(int count)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> within(-1, 1);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i)
  {
    points.emplace_back(3 * within(random), within(random), 2 * within(random) + 7);
  }
  return points;
}

struct Bounds
{
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e300);
  Eigen::Vector2d high = -low;
};

Bounds Pixels(const Camera& camera, const std::vector<Eigen::Vector3d>& points)
{
  Bounds bounds;
  for (const Eigen::Vector3d& point : points)
  {
    EXPECT_GT(camera.Depth(point), 0);
    bounds.low = bounds.low.cwiseMin(camera.Project(point));
    bounds.high = bounds.high.cwiseMax(camera.Project(point));
  }
  return bounds;
}

}

TEST(FramePoints, FillsThePictureToItsMarginOneWayAndIsInTheMiddleTheOther)
{
  const auto points = Cloud(500);
  const Camera camera = FramePoints(AnyCamera(), points);
  EXPECT_EQ(camera.R, AnyCamera().R);
  const Bounds seen = Pixels(camera, points);
  const Eigen::Vector2d margin(640 / 52.0, 480 / 52.0);
  const Eigen::Vector2d atLow = seen.low - margin;
  const Eigen::Vector2d atHigh = Eigen::Vector2d(640, 480) - margin - seen.high;
  EXPECT_GT(std::min(atLow.minCoeff(), atHigh.minCoeff()), -1e-9);
  EXPECT_TRUE((atLow.x() < 1e-9 && atHigh.x() < 1e-9) || (atLow.y() < 1e-9 && atHigh.y() < 1e-9));
}

TEST(FramePoints, OnePointIsSeenAndNoneLeavesTheCamera)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(FramePoints(AnyCamera(), {}).t, AnyCamera().t);
  EXPECT_EQ(FramePoints(AnyCamera(), { { nan, 0, 0 } }).t, AnyCamera().t);
  EXPECT_TRUE(FramePoints(AnyCamera(), { { 1, 2, 3 }, { nan, 0, 0 } }).t.allFinite());
}

TEST(FramePoints, HeedsNoOutlierUnlessAsked)
{
  auto points = Cloud(1000);
  const double near = -FramePoints(AnyCamera(), points).Depth({ 0, 0, 0 });
  const double same = -FramePoints(AnyCamera(), points, Outliers::MayBeCutOff).Depth({ 0, 0, 0 });
  EXPECT_NEAR(same, near, 0.1) << "nothing is far off";
  points.emplace_back(300, 500, -400);
  const double heedless =
    -FramePoints(AnyCamera(), points, Outliers::MayBeCutOff).Depth({ 0, 0, 0 });
  EXPECT_NEAR(heedless, same, 3);
  EXPECT_LT(-FramePoints(AnyCamera(), points).Depth({ 0, 0, 0 }), near - 100);
}

TEST(FramePoints, FarEnoughJustHoldsThePoints)
{
  const Eigen::Vector3d middle(0, 0, 7);
  const auto points = Cloud(2000);
  Camera camera = AnyCamera();
  camera.K.col(2) << 320, 240, 1;
  const auto at = [&](double depth)
  {
    Camera moved = camera;
    moved.t = Eigen::Vector3d(0, 0, depth) - camera.R * middle;
    return moved;
  };
  const double times = FarEnough(at(2), middle, points);
  const Bounds seen = Pixels(at(2 * times), points);
  EXPECT_GE(seen.low.minCoeff(), 0);
  EXPECT_TRUE(seen.high.x() <= 640 && seen.high.y() <= 480);
  const double closest =
    std::min({ seen.low.x(), seen.low.y(), 640 - seen.high.x(), 480 - seen.high.y() });
  EXPECT_LT(closest, 0.03 * 640);
  EXPECT_EQ(FarEnough(at(2), middle, {}), 1);
}

TEST(FramePoints, AnotherSizeHoldsAllThatTheOldOneHeld)
{
  const Camera camera = AnyCamera();
  for (const auto& [width, height] : { std::pair(320, 240), { 1000, 100 }, { 50, 900 } })
  {
    const Camera sized = WithSize(camera, width, height);
    const Eigen::Vector3d corners[] = { camera.Unproject({ 0, 0 }, 2),
      camera.Unproject({ 640, 480 }, 2) };
    const Bounds seen = Pixels(sized, { corners[0], corners[1] });
    EXPECT_NEAR(seen.low.x() + seen.high.x(), width, 1e-9);
    EXPECT_NEAR(seen.low.y() + seen.high.y(), height, 1e-9);
    EXPECT_NEAR(std::min(seen.low.x(), seen.low.y()), 0, 1e-9);
  }
}
