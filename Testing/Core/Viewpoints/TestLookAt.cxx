// SPDX-License-Identifier: BSD-3-Clause
#include "Viewpoints/LookAt.h"

#include "Support/Core/PlaceAround.h"

#include <gtest/gtest.h>

using namespace freespace;

TEST(LookAt, PutsTheMiddleInTheMiddleAndKeepsTheHorizon)
{
  const Eigen::Vector3d middle(1, 2, 3);
  const Camera camera = PlaceAround(0.7, 0.4, 5, middle);
  EXPECT_TRUE(camera.Project(middle).isApprox(Eigen::Vector2d(320, 240), 1e-12));
  EXPECT_NEAR(camera.Depth(middle), 5, 1e-12);
  EXPECT_NEAR((camera.R * camera.R.transpose() - Eigen::Matrix3d::Identity()).norm(), 0, 1e-12);
  EXPECT_NEAR(camera.R.determinant(), 1, 1e-12);
  EXPECT_NEAR(camera.R(0, 2), 0, 1e-12) << "right is level";
  EXPECT_LT(camera.Project(middle + Eigen::Vector3d::UnitZ() * 0.1).y(), 240) << "up is up";
}
