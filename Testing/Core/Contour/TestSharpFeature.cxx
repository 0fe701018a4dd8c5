// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/Sharp/SharpFeature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace freespace;
using Eigen::AlignedBox3d;
using Eigen::Vector3d;

namespace
{

const double cosine60 = 0.5;

AlignedBox3d UnitBox()
{
  return AlignedBox3d(Vector3d::Zero(), Vector3d::Ones());
}

double Degrees(const Vector3d& a, const Vector3d& b)
{
  return std::acos(std::min(1.0, a.dot(b))) * 180 / M_PI;
}

// Points on the two sides of the edge x = y = 0, with normals that are off by some 20 degrees.
std::vector<SurfacePlane> RoughEdge(int perSide)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0.0, 2.0);
  std::normal_distribution<double> tilt(0.0, 0.25);
  std::vector<SurfacePlane> planes;
  for (int i = 0; i < 2 * perSide; ++i)
  {
    const int axis = i % 2;
    Vector3d point(0, 0, place(random));
    point[1 - axis] = -place(random);
    const Vector3d off(tilt(random), tilt(random), tilt(random));
    planes.push_back({ point, (Vector3d(Vector3d::Unit(axis)) + off).normalized() });
  }
  return planes;
}

}

TEST(SharpFeature, EdgeAndCornerAreWhereThePlanesMeet)
{
  const std::vector<SurfacePlane> edge = { { { 0.6, 0.1, 0.2 }, Vector3d::UnitX() },
    { { 0.1, 0.7, 0.4 }, Vector3d::UnitY() } };
  Vector3d position;
  ASSERT_TRUE(FindSharpFeature(edge, cosine60, UnitBox(), position));
  EXPECT_LT((position - Vector3d(0.6, 0.7, 0.3)).norm(), 1e-12);

  std::vector<SurfacePlane> corner = edge;
  corner.push_back({ { 0.3, 0.3, 0.8 }, Vector3d::UnitZ() });
  ASSERT_TRUE(FindSharpFeature(corner, cosine60, UnitBox(), position));
  EXPECT_LT((position - Vector3d(0.6, 0.7, 0.8)).norm(), 1e-12);
}

TEST(SharpFeature, StaysInTheBox)
{
  const std::vector<SurfacePlane> edge = { { { 1.3, 0.1, 0.2 }, Vector3d::UnitX() },
    { { 0.1, 0.7, 0.4 }, Vector3d::UnitY() } };
  Vector3d position;
  ASSERT_TRUE(FindSharpFeature(edge, cosine60, UnitBox(), position));
  EXPECT_LT((position - Vector3d(1.0, 0.7, 0.3)).norm(), 1e-12);

  std::vector<SurfacePlane> corner = edge;
  corner.push_back({ { 0.3, 0.3, -0.1 }, Vector3d::UnitZ() });
  ASSERT_TRUE(FindSharpFeature(corner, cosine60, UnitBox(), position));
  EXPECT_LT((position - Vector3d(1.0, 0.7, 0.0)).norm(), 1e-12);
}

TEST(SharpFeature, FlatAndUnknownAreNotSharp)
{
  Vector3d position;
  EXPECT_FALSE(FindSharpFeature({}, cosine60, UnitBox(), position));
  const SurfacePlane flat{ { 0.5, 0.5, 0.5 }, Vector3d::UnitX() };
  EXPECT_FALSE(FindSharpFeature({ flat }, cosine60, UnitBox(), position));
  EXPECT_FALSE(FindSharpFeature({ flat, flat }, cosine60, UnitBox(), position));
  const SurfacePlane bent{ { 0.5, 0.5, 0.5 }, Vector3d(1, 1, 0).normalized() }; // 45 degrees
  EXPECT_FALSE(FindSharpFeature({ flat, bent }, cosine60, UnitBox(), position));
  const SurfacePlane across{ { 0.5, 0.5, 0.5 }, Vector3d::UnitY() };
  const SurfacePlane unknown{ { 0.5, 0.5, 0.5 }, Vector3d::Zero() };
  EXPECT_FALSE(FindSharpFeature({ flat, across, unknown }, cosine60, UnitBox(), position));
}

TEST(SharpFeature, SmoothingTakesRoughnessOffBothSidesOfAnEdge)
{
  std::vector<SurfacePlane> planes = RoughEdge(30);
  const auto meanError = [&]()
  {
    double sum = 0;
    for (std::size_t i = 0; i < planes.size(); ++i)
    {
      sum += Degrees(planes[i].normal, Vector3d::Unit(static_cast<int>(i % 2)));
    }
    return sum / planes.size();
  };
  const double before = meanError();
  SmoothNormals(planes, RoughEdge(30), 1.0);
  EXPECT_GT(before, 12);
  EXPECT_LT(meanError(), 0.4 * before);
  for (const SurfacePlane& plane : planes)
  {
    EXPECT_NEAR(plane.normal.norm(), 1, 1e-12);
  }
}

TEST(SharpFeature, SmoothingLeavesCleanEdgesAndUnknownNormalsAlone)
{
  std::vector<SurfacePlane> none;
  SmoothNormals(none, none, 1.0);
  EXPECT_TRUE(none.empty());
  std::vector<SurfacePlane> planes = { { { 0, 0, 0 }, Vector3d::UnitX() },
    { { 0.1, 0, 0 }, Vector3d::UnitY() }, { { 0, 0.1, 0 }, -Vector3d::UnitX() },
    { { 0, 0, 0.1 }, Vector3d::Zero() } };
  const std::vector<SurfacePlane> given = planes;
  SmoothNormals(planes, given, 1.0);
  for (std::size_t i = 0; i < planes.size(); ++i)
  {
    EXPECT_EQ(planes[i].normal, given[i].normal) << i;
  }
}

TEST(SharpFeature, TellsWhetherNormalsDiffer)
{
  const SurfacePlane x{ Vector3d::Zero(), Vector3d::UnitX() };
  const SurfacePlane y{ Vector3d::Zero(), Vector3d::UnitY() };
  EXPECT_FALSE(NormalsDiffer({}, 0.5));
  EXPECT_FALSE(NormalsDiffer({ x, x }, 0.5));
  EXPECT_TRUE(NormalsDiffer({ x, x, y }, 0.5));
}

TEST(SharpFeature, MovesToTheBoundaryFromEitherSide)
{
  const auto isFree = [](const Vector3d& point) { return point.z() > 0.4; };
  const Vector3d up = Vector3d(0.3, 0.0, 1.0).normalized();
  for (double height : { 0.1, 0.35, 0.45, 0.8 })
  {
    const Vector3d start(0.5, 0.5, height);
    Vector3d point = start;
    ASSERT_TRUE(MoveToBoundary(point, up, UnitBox(), isFree));
    EXPECT_NEAR(point.z(), 0.4, 1.0 / 16 / 128);
    EXPECT_LT((point - start).cross(up).norm(), 1e-12);
  }
}

TEST(SharpFeature, StaysWhereTheBoxHoldsNoBoundaryOnTheWay)
{
  const auto isFree = [](const Vector3d& point) { return point.z() > 1.2; };
  const Vector3d start(0.5, 0.5, 0.7);
  Vector3d point = start;
  EXPECT_FALSE(MoveToBoundary(point, Vector3d::UnitZ(), UnitBox(), isFree));
  EXPECT_FALSE(MoveToBoundary(point, -Vector3d::UnitZ(), UnitBox(), isFree));
  EXPECT_FALSE(MoveToBoundary(point, Vector3d::Zero(), UnitBox(), isFree));
  EXPECT_FALSE(MoveToBoundary(point, Vector3d::Constant(NAN), UnitBox(), isFree));
  EXPECT_EQ(point, start);
}
