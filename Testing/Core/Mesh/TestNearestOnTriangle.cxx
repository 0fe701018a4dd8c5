// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/NearestOnTriangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

double DistanceToSegment(const Vector3d& p, const Vector3d& a, const Vector3d& b)
{
  const double squared = (b - a).squaredNorm();
  const double t = squared > 0 ? std::clamp((p - a).dot(b - a) / squared, 0.0, 1.0) : 0;
  return (a + t * (b - a) - p).norm();
}

}

// A place of a convex set is the nearest to a point exactly when no corner of the set lies beyond the plane through
// the place that is perpendicular to the way to the point.
TEST(NearestOnTriangle, NoCornerIsNearer)
{
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto somewhere = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
  std::array<int, 4> onFeature = {}; // places with so many weights of zero
  for (int trial = 0; trial < 5000; ++trial)
  {
    const std::array<Vector3d, 3> corners = { somewhere(), somewhere(), somewhere() };
    const Vector3d point = 2 * somewhere();
    const Vector3d weights = NearestOnTriangle(point, corners[0], corners[1], corners[2]);
    EXPECT_NEAR(weights.sum(), 1, 1e-12);
    EXPECT_GE(weights.minCoeff(), 0);
    const Vector3d place =
      weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
    for (const Vector3d& corner : corners)
    {
      EXPECT_LE((point - place).dot(corner - place), 1e-9);
    }
    ++onFeature[(weights.array() == 0).count()];
  }
  EXPECT_GT(onFeature[0], 200) << "inside";
  EXPECT_GT(onFeature[1], 200) << "on an edge";
  EXPECT_GT(onFeature[2], 200) << "in a corner";
}

TEST(NearestOnTriangle, OfATriangleWithoutAreaIsOnItsLongestEdge)
{
  const Vector3d a(0, 0, 0), b(-3, -3, -3), c(-1, -1, -1), p(-2.5, -2.5, -1.5);
  const Vector3d weights = NearestOnTriangle(p, a, b, c);
  const Vector3d place = weights[0] * a + weights[1] * b + weights[2] * c;
  EXPECT_NEAR((place - p).norm(), DistanceToSegment(p, a, b), 1e-12);
  for (const auto& corners : { std::array<Vector3d, 3>{ a, a, b }, { a, b, a }, { b, a, a } })
  {
    const Vector3d w = NearestOnTriangle(p, corners[0], corners[1], corners[2]);
    const Vector3d at = w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2];
    EXPECT_NEAR((at - p).norm(), DistanceToSegment(p, a, b), 1e-12);
  }
  EXPECT_EQ(NearestOnTriangle(p, c, c, c).sum(), 1);
}
