// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Fit/TriangleGrid.h"

#include "Support/Core/BoxMesh.h"

#include <gtest/gtest.h>

#include <random>

using namespace freespace;
using Eigen::Vector3d;

TEST(TriangleGrid, FindsTheNearestFacingTriangleAsBruteForceDoes)
{
  const ContourMesh mesh = BoxMesh(6);
  const TriangleGrid grid(mesh.points, mesh.triangles, 0.3);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1, 1);
  int found = 0;
  for (int i = 0; i < 300; ++i)
  {
    const Vector3d point(place(random), place(random), place(random));
    const Vector3d direction(place(random), place(random), place(random));
    constexpr double reach = 0.4;
    double least = reach;
    for (const auto& [a, b, c] : mesh.triangles)
    {
      const Vector3d &p = mesh.points[a], &q = mesh.points[b], &r = mesh.points[c];
      if (direction.dot((q - p).cross(r - p)) < 0)
      {
        const Vector3d w = NearestOnTriangle(point, p, q, r);
        EXPECT_NEAR(w.sum(), 1, 1e-9);
        least = std::min(least, (w[0] * p + w[1] * q + w[2] * r - point).norm());
      }
    }
    const TrianglePlace nearest = grid.Nearest(point, direction, reach);
    EXPECT_EQ(nearest.triangle >= 0, least < reach);
    if (nearest.triangle >= 0)
    {
      ++found;
      const auto& [a, b, c] = mesh.triangles[nearest.triangle];
      const Vector3d& w = nearest.weights;
      EXPECT_NEAR(
        (w[0] * mesh.points[a] + w[1] * mesh.points[b] + w[2] * mesh.points[c] - point).norm(),
        least, 1e-12);
    }
  }
  EXPECT_GT(found, 50);
}
