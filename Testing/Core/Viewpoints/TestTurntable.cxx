// SPDX-License-Identifier: BSD-3-Clause
#include "Common/Error.h"
#include "Viewpoints/Turntable.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace freespace;

namespace
{

Camera LookFrom(const Eigen::Vector3d& from, const Eigen::Vector3d& at)
{
  Camera camera;
  camera.width = 100;
  camera.height = 80;
  camera.K << 90, 0, 50, 0, 90, 40, 0, 0, 1;
  const Eigen::Vector3d forward = (at - from).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  camera.R << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  camera.t = -camera.R * from;
  return camera;
}

}

TEST(Turntable, GoesAroundWhatTheCamerasLookAt)
{
  const Eigen::Vector3d middle(10, 20, 3);
  std::vector<Camera> cameras;
  for (const double angle : { 0.0, 0.5, 1.2, 2.0 }) // some of one side only
  {
    cameras.push_back(
      LookFrom(middle + Eigen::Vector3d(4 * std::cos(angle), 4 * std::sin(angle), 2), middle));
  }
  const std::vector<Camera> path = TurntableCameras(cameras, 8);
  ASSERT_EQ(path.size(), 8u);
  for (std::size_t i = 0; i < path.size(); ++i)
  {
    EXPECT_TRUE(path[i].R.isUnitary(1e-12));
    EXPECT_NEAR(path[i].R.determinant(), 1, 1e-12);
    EXPECT_LT((path[i].Project(middle) - Eigen::Vector2d(50, 40)).norm(), 1e-6);
    const double step = (path[i].Center() - path[(i + 1) % 8].Center()).norm();
    const double next = (path[(i + 1) % 8].Center() - path[(i + 2) % 8].Center()).norm();
    EXPECT_NEAR(step, next, 1e-9);
    EXPECT_EQ(path[i].width, 100);
  }
}

TEST(Turntable, NeedsAMiddle)
{
  EXPECT_THROW(TurntableCameras({}, 4), Error);
  const Camera one = LookFrom({ 4, 0, 2 }, { 0, 0, 0 });
  EXPECT_THROW(TurntableCameras({ one, one }, 4), Error);
}

TEST(Turntable, IsFarEnoughForAllPictures)
{
  const Eigen::Vector3d middle(10, 20, 3);
  std::vector<Camera> cameras;
  for (const double angle : { 0.0, 1.0, 2.0, 4.0 })
  {
    cameras.push_back(
      LookFrom(middle + Eigen::Vector3d(4 * std::cos(angle), 4 * std::sin(angle), 2), middle));
  }
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 8; ++i)
  {
    points.push_back(middle + Eigen::Vector3d(i & 1 ? 9 : -9, i & 2 ? 9 : -9, i & 4 ? 1 : -1));
  }
  const std::vector<Camera> near = TurntableCameras(cameras, 5);
  const std::vector<Camera> path = TurntableCameras(cameras, 5, points);
  for (std::size_t i = 0; i < path.size(); ++i)
  {
    EXPECT_TRUE(path[i].R.isApprox(near[i].R, 1e-9)) << "in the same direction";
    for (const Eigen::Vector3d& point : points)
    {
      EXPECT_TRUE(path[i].Depth(point) > 0 && path[i].Sees(path[i].Project(point)));
    }
  }
}
