// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Fit/Untangle.h"

#include "Support/Core/BoxMesh.h"

#include <gtest/gtest.h>

using namespace freespace;
using Eigen::Vector3d;

TEST(Untangle, TakesBackWhatMeetsItself)
{
  ContourMesh mesh = BoxMesh();
  const std::vector<Vector3d> before = mesh.points;
  AddNoise(mesh.points, 0.05);
  ASSERT_GT(CountIntersections(mesh.points, mesh.triangles), 0u);
  UntangleOptions options;
  options.cell = 0.1;
  Untangle(mesh.points, before, mesh.triangles, options);
  EXPECT_EQ(CountIntersections(mesh.points, mesh.triangles), 0u);
  EXPECT_NE(mesh.points, before);
}
