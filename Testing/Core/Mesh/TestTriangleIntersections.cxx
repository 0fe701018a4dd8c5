// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/TriangleIntersections.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace freespace;
using Eigen::Vector3d;
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

namespace
{

Pairs MeetingTriangles(const std::vector<Vector3d>& points,
  const std::vector<std::int32_t>& triangles, std::vector<std::size_t> suspects = {})
{
  const TriangleSoup mesh = { [&](std::int32_t v) { return points[v]; }, triangles.data(),
    triangles.size() / 3 };
  if (suspects.empty())
  {
    suspects.resize(mesh.count);
    std::iota(suspects.begin(), suspects.end(), 0);
  }
  return FindIntersections(mesh, suspects, 0.7, [](std::size_t, std::size_t) { return true; });
}

const Vector3d X(1, 0, 0), Y(0, 1, 0), Z(0, 0, 1), O(0, 0, 0);

}

TEST(TriangleIntersections, ApartAndThroughEachOther)
{
  EXPECT_EQ(MeetingTriangles({}, {}), Pairs());
  EXPECT_EQ(MeetingTriangles({ O, X, Y, Z, X + Z, Y + Z }, { 0, 1, 2, 3, 4, 5 }), Pairs());
  const Pairs one = { { 0, 1 } };
  EXPECT_EQ(MeetingTriangles(
              { O, X, Y, 0.2 * (X + Y) - Z, 0.2 * (X + Y) + Z, X + Y + Z }, { 0, 1, 2, 3, 4, 5 }),
    one);
}

TEST(TriangleIntersections, SharedCornersAndEdgesAreNoMeeting)
{
  EXPECT_EQ(MeetingTriangles({ O, X, Y, Z }, { 0, 1, 2, 1, 0, 3, 2, 1, 3, 0, 2, 3 }), Pairs());
  EXPECT_EQ(MeetingTriangles({ O, X, Y, -X, -Y }, { 0, 1, 2, 0, 3, 4 }), Pairs());
  // Flat, side by side.
  EXPECT_EQ(MeetingTriangles({ O, X, Y, X + Y }, { 0, 1, 2, 1, 3, 2 }), Pairs());
}

TEST(TriangleIntersections, FoldsAndOverlapsAre)
{
  const Pairs one = { { 0, 1 } };
  // Folded about the edge from O to X; about the corner O; coinciding points that are not the same.
  EXPECT_EQ(MeetingTriangles({ O, X, Y, X + 0.5 * Y }, { 0, 1, 2, 1, 0, 3 }), one);
  EXPECT_EQ(MeetingTriangles(
              { O, X, Y, 0.2 * X + 0.2 * Y - Z, 0.3 * X + 0.2 * Y + Z }, { 0, 1, 2, 0, 3, 4 }),
    one);
  EXPECT_EQ(MeetingTriangles({ O, X, Y, Y, X + Y + Z }, { 0, 1, 2, 1, 3, 4 }), one);
}

TEST(TriangleIntersections, OnlySuspectsAndThoseWithoutArea)
{
  const std::vector<Vector3d> points = { O, X, Y, 0.2 * (X + Y) - Z, 0.2 * (X + Y) + Z, X + Y + Z,
    0.5 * X };
  const std::vector<std::int32_t> triangles = { 0, 1, 2, 3, 4, 5, 0, 1, 6 };
  const Pairs crossing = { { 0, 1 } }, flat = { { 2, 2 } };
  EXPECT_EQ(MeetingTriangles(points, triangles, { 1 }), crossing);
  EXPECT_EQ(MeetingTriangles(points, triangles, { 2 }), flat);
}
