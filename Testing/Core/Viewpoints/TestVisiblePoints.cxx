// SPDX-License-Identifier: BSD-3-Clause
#include "Viewpoints/VisiblePoints.h"

#include <gtest/gtest.h>

using namespace freespace;

namespace
{

Camera Front(int scale = 1)
{
  Camera camera;
  camera.K << 100 * scale, 0, 50 * scale, 0, 100 * scale, 50 * scale, 0, 0, 1;
  camera.width = camera.height = 100 * scale;
  return camera;
}

// Adds a square of n x n points in the plane z = depth, |x|, |y| <= half.
void AddGrid(TriangleMesh& mesh, double half, double depth, int n)
{
  const int first = static_cast<int>(mesh.points.size());
  for (int i = 0; i < n * n; ++i)
  {
    mesh.points.emplace_back(
      half * (2.0 * (i % n) / (n - 1) - 1), half * (2.0 * (i / n) / (n - 1) - 1), depth);
    if (i % n > 0 && i >= n)
    {
      mesh.triangles.push_back({ first + i, first + i - 1, first + i - n - 1 });
      mesh.triangles.push_back({ first + i, first + i - n - 1, first + i - n });
    }
  }
}

}

// A square at depth 2 hides of one at depth 4 what is within twice its size.
TEST(VisiblePoints, WhatIsInFrontHidesWhatIsBehind)
{
  for (const int scale : { 1, 20 }) // larger than the depth buffer, too
  {
    TriangleMesh mesh;
    AddGrid(mesh, 0.5, 2, 9);
    AddGrid(mesh, 1.9, 4, 39); // 0.1 apart
    int front = 0, behind = 0;
    for (const Eigen::Vector3d& point : VisiblePoints(mesh, Front(scale)))
    {
      front += point.z() == 2;
      behind += point.z() == 4;
      EXPECT_FALSE(point.z() == 4 && point.head<2>().cwiseAbs().maxCoeff() < 0.95)
        << point.transpose();
    }
    EXPECT_EQ(front, 81);
    // Of 39 x 39 points the 19 x 19 within 0.9 are hidden; those at 1.0 lie on the border of the shadow.
    EXPECT_GE(behind, 39 * 39 - 21 * 21);
    EXPECT_LE(behind, 39 * 39 - 19 * 19);
  }
}

TEST(VisiblePoints, OnlyWithinTheImageAndInFrontOfTheCamera)
{
  TriangleMesh mesh;
  AddGrid(mesh, 2, 1, 41); // 0.1 apart; the image shows |x|, |y| <= 0.5
  AddGrid(mesh, 0.2, -1, 5);
  const auto seen = VisiblePoints(mesh, Front());
  EXPECT_GE(seen.size(), 9u * 9u);
  EXPECT_LE(seen.size(), 11u * 11u);
  for (const Eigen::Vector3d& point : seen)
  {
    EXPECT_EQ(point.z(), 1);
    EXPECT_LE(point.head<2>().cwiseAbs().maxCoeff(), 0.5 + 1e-9);
  }
}

TEST(VisiblePoints, AnEmptyMeshHasNone)
{
  EXPECT_TRUE(VisiblePoints({}, Front()).empty());
}
