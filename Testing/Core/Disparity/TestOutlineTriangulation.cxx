// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/OutlineTriangulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

using namespace freespace;
using Eigen::Vector2d;

namespace
{

Outline Rectangle(double x0, double y0, double x1, double y1)
{
  return { Vector2d(x0, y0), Vector2d(x1, y0), Vector2d(x1, y1), Vector2d(x0, y1) };
}

bool IsWithin(const Vector2d& p, const Outline& rectangle)
{
  return p.x() > rectangle[0].x() && p.x() < rectangle[2].x() && p.y() > rectangle[0].y() &&
    p.y() < rectangle[2].y();
}

// Of each triangle twice the area, all of one sign.
double AreaOfTriangles(const PlanarTriangles& triangles)
{
  double sum = 0;
  for (const auto& [a, b, c] : triangles.triangles)
  {
    const Vector2d ab = triangles.points[b] - triangles.points[a];
    const Vector2d ac = triangles.points[c] - triangles.points[a];
    const double twice = ab.x() * ac.y() - ab.y() * ac.x();
    EXPECT_GT(twice, 0);
    sum += twice / 2;
  }
  return sum;
}

}

TEST(OutlineTriangulation, OfARectangleWithAHole)
{
  const Outline outer = Rectangle(0, 0, 10, 6), hole = Rectangle(2, 1, 5, 4);
  const auto result = TriangulateOutlines(
    { outer, hole }, [&](const Vector2d& p) { return IsWithin(p, outer) && !IsWithin(p, hole); });
  EXPECT_EQ(result.points.size(), 8u);
  EXPECT_EQ(result.triangles.size(), 8u); // points + 2 x holes - 2
  EXPECT_NEAR(AreaOfTriangles(result), 60 - 9, 1e-9);
}

TEST(OutlineTriangulation, OfPiecesApartAndTouching)
{
  const Outline left = Rectangle(0, 0, 1, 1), right = Rectangle(1, 0, 3, 1),
                far = Rectangle(9, 9, 10, 10);
  const auto result = TriangulateOutlines({ left, right, far },
    [&](const Vector2d& p) { return IsWithin(p, left) || IsWithin(p, right) || IsWithin(p, far); });
  EXPECT_NEAR(AreaOfTriangles(result), 1 + 2 + 1, 1e-9);
}

TEST(OutlineTriangulation, OfOverlappingOutlinesMakesTheirCrossings)
{
  const Outline a = Rectangle(0, 0, 4, 2), b = Rectangle(1, -1, 3, 3);
  const auto result = TriangulateOutlines(
    { a, b }, [&](const Vector2d& p) { return IsWithin(p, a) || IsWithin(p, b); });
  EXPECT_NEAR(AreaOfTriangles(result), 8 + 8 - 4, 1e-9);
  EXPECT_EQ(result.points.size(), 12u);
}

TEST(OutlineTriangulation, OfNothingIsEmpty)
{
  const auto all = [](const Vector2d&) { return true; };
  EXPECT_TRUE(TriangulateOutlines({}, all).triangles.empty());
  EXPECT_TRUE(TriangulateOutlines({ {} }, all).triangles.empty());
  EXPECT_TRUE(TriangulateOutlines({ { Vector2d(1, 1) } }, all).triangles.empty());
  EXPECT_TRUE(TriangulateOutlines({ { Vector2d(0, 0), Vector2d(1, 1), Vector2d(2, 2) } }, all)
                .triangles.empty());
  EXPECT_TRUE(TriangulateOutlines({ Rectangle(0, 0, 1, 1) },
    [](const Vector2d&) {
      return false;
    }).points.empty());
}
