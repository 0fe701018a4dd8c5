// SPDX-License-Identifier: BSD-3-Clause
#include "Epipolar/EpipolarPair.h"

#include "Common/Error.h"
#include "Support/Core/RandomCameras.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace freespace;

TEST(EpipolarPair, PointsLieOnOneRowAndGiveTheirDisparity)
{
  for (unsigned int seed = 0; seed < 50; ++seed)
  {
    RandomCameras random(seed);
    const Camera reference = random.Next(), other = random.Next();
    const EpipolarPair pair(reference, other);
    const Eigen::Vector3d point(
      random.Uniform(-0.2, 0.2), random.Uniform(-0.2, 0.2), random.Uniform(0.7, 1.5));
    const EpipolarPair::Ray a = pair.FromReference(reference.Project(point));
    const EpipolarPair::Ray b = pair.FromOther(other.Project(point));
    EXPECT_GT(a.scale, 0);
    EXPECT_NEAR(a.v, b.v, 1e-8) << seed;
    const double disparity = 1 / reference.Depth(point);
    EXPECT_NEAR(pair.Disparity(a, b.u), disparity, 1e-9) << seed;
    EXPECT_NEAR(pair.Column(a, disparity), b.u, 1e-6) << seed;
  }
}

TEST(EpipolarPair, JacobianIsTheDerivative)
{
  RandomCameras random(7);
  const Camera reference = random.Next(), other = random.Next();
  const EpipolarPair pair(reference, other);
  const Eigen::Vector2d pixel(70, 120);
  const EpipolarPair::Ray ray = pair.FromReference(pixel);
  const Eigen::Matrix2d jacobian = pair.ReferenceJacobian(ray);
  for (int k = 0; k < 2; ++k)
  {
    const double step = 1e-4;
    const EpipolarPair::Ray moved = pair.FromReference(pixel + step * Eigen::Vector2d::Unit(k));
    EXPECT_NEAR((moved.u - ray.u) / step, jacobian(0, k), 1e-4);
    EXPECT_NEAR((moved.v - ray.v) / step, jacobian(1, k), 1e-4);
  }
}

TEST(EpipolarPair, OnePlace)
{
  const Camera camera = CrossOfCameras()[0];
  EXPECT_THROW(EpipolarPair(camera, camera), Error);
}

TEST(EpipolarPair, OneStraightBeforeTheOther)
{
  Camera other = CrossOfCameras()[0];
  other.t = Eigen::Vector3d(0, 0, -0.2);
  const EpipolarPair pair(CrossOfCameras()[0], other); // useless, but no error
  EXPECT_TRUE(std::isfinite(pair.FromReference({ 10, 10 }).scale));
}
