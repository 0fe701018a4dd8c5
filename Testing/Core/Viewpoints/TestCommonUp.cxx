// SPDX-License-Identifier: BSD-3-Clause
#include "Viewpoints/CommonUp.h"
#include "Viewpoints/LookAt.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace freespace;

namespace
{

constexpr double oneDegree = M_PI / 180;

/// Looks at the origin from around `up`, with the horizon level and then rolled to the right.
Camera DirectionFromUp(const Eigen::Vector3d& up, double azimuth, double elevation, double roll)
{
  const Eigen::Vector3d side = up.unitOrthogonal();
  const Eigen::Vector3d from = std::sin(elevation) * up +
    std::cos(elevation) * (std::cos(azimuth) * side + std::sin(azimuth) * up.cross(side));
  Camera camera = LookAt(Camera(), 3 * from, Eigen::Vector3d::Zero(), up);
  camera.R = Eigen::AngleAxisd(-roll, Eigen::Vector3d::UnitZ()) * camera.R;
  return camera;
}

double Off(const std::vector<Camera>& cameras, const Eigen::Vector3d& up)
{
  const Eigen::Vector3d found = CommonUp(cameras);
  EXPECT_NEAR(found.norm(), 1, 1e-12);
  return std::atan2(found.cross(up).norm(), found.dot(up)) / oneDegree;
}

const Eigen::Vector3d askew = Eigen::Vector3d(1, 2, -3).normalized();

std::vector<Camera> Ring(double elevation, double roll, double extent = 360 * oneDegree)
{
  std::vector<Camera> ring;
  for (int i = 0; i < 12; ++i)
  {
    ring.push_back(DirectionFromUp(askew, extent * i / 12, elevation, roll));
  }
  return ring;
}

}

TEST(CommonUp, NothingWithoutCameras)
{
  EXPECT_TRUE(CommonUp({}).isZero());
}

TEST(CommonUp, TheImagesOwnOfOneCamera)
{
  const Camera one = DirectionFromUp(askew, 0.3, 0.5, 0.7);
  EXPECT_LT(Off({ one }, -one.R.row(1)), 1e-6);
  EXPECT_LT(Off({ one, one, one }, -one.R.row(1)), 1e-6) << "a cluster of parallel cameras";
}

TEST(CommonUp, OfRingsHoweverSteepAndHoweverHeld)
{
  for (const double elevation : { 5.0, 30.0, 60.0, 75.0 })
  {
    for (const double roll : { 0.0, 90.0, -90.0 })
    {
      EXPECT_LT(Off(Ring(elevation * oneDegree, roll * oneDegree), askew), 0.01)
        << elevation << " " << roll;
    }
  }
}

TEST(CommonUp, OfAnUprightRingThatLooksUp)
{
  EXPECT_LT(Off(Ring(-30 * oneDegree, 0), askew), 0.01);
}

TEST(CommonUp, OfAnArcHeldOnItsSide)
{
  // A shorter one might as well be upright and go over the top.
  EXPECT_LT(Off(Ring(20 * oneDegree, 90 * oneDegree, 180 * oneDegree), askew), 0.01);
}

TEST(CommonUp, OfAFewHeldOtherwiseByUnsteadyHands)
{
  std::mt19937 random(7);
  std::normal_distribution<double> shake(0, 4 * oneDegree);
  std::vector<Camera> cameras;
  for (int i = 0; i < 40; ++i)
  {
    const double anyhow = 0.13 * i * i;
    const double roll = i % 10 == 0 ? anyhow : i % 10 < 6 ? 0 : -90 * oneDegree;
    cameras.push_back(DirectionFromUp(askew, i, (10 + i) * oneDegree, roll + shake(random)));
  }
  EXPECT_LT(Off(cameras, askew), 3);
}

TEST(CommonUp, OfCamerasThatLookStraightDownIsInTheirImages)
{
  std::vector<Camera> strip;
  for (int i = 0; i < 8; ++i)
  {
    Camera down;
    down.R = Eigen::Vector3d(1, -1, -1).asDiagonal();
    down.t = down.R * Eigen::Vector3d(-i, 0, -5);
    strip.push_back(down);
  }
  EXPECT_LT(Off(strip, Eigen::Vector3d::UnitY()), 1e-6);
}
