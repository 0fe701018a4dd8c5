// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Fit/Untangle.h"

#include "Mesh/TriangleIntersections.h"
#include "Support/Core/BoxMesh.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

std::size_t CountIntersections(
  const std::vector<Vector3d>& points, const std::vector<std::array<std::int32_t, 3>>& triangles)
{
  TriangleSoup soup;
  soup.position = [&](std::int32_t v) { return points[v]; };
  soup.triangles = triangles.front().data();
  soup.count = triangles.size();
  std::vector<std::size_t> all(triangles.size());
  std::iota(all.begin(), all.end(), 0);
  return FindIntersections(soup, all, 0.1, [](std::size_t, std::size_t) { return true; }).size();
}

}

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
