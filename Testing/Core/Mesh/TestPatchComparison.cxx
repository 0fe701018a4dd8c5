// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/PatchComparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace freespace;
using Eigen::Vector3d;
using Patch = PatchComparison::Triangles;

namespace
{

// Patches are over z = 0, turned, so that no axis of space is special.
Vector3d Above(double x, double y, double z = 0)
{
  static const Eigen::Isometry3d turned = Eigen::Translation3d(3, -1, 7) *
    Eigen::AngleAxisd(1.1, Vector3d(1, 2, -0.5).normalized()) * Eigen::Isometry3d::Identity();
  return turned * Vector3d(x, y, z);
}

// The triangles from a centre to the sides of a polygon.
Patch FanPatch(const Vector3d& center, const std::vector<Vector3d>& border)
{
  Patch fan;
  for (std::size_t i = 0; i < border.size(); ++i)
  {
    fan.push_back({ center, border[i], border[(i + 1) % border.size()] });
  }
  return fan;
}

Patch SquarePatch()
{
  return { { Above(-1, -1), Above(1, -1), Above(1, 1) },
    { Above(-1, -1), Above(1, 1), Above(-1, 1) } };
}

}

TEST(PatchComparison, HeightOfPointsOverThePatch)
{
  PatchComparison comparison;
  ASSERT_TRUE(comparison.Begin(SquarePatch(), SquarePatch()));
  for (const double height : { -2.0, 0.0, 0.25, 3.0 })
  {
    EXPECT_NEAR(
      comparison.HeightAbove(SquarePatch(), Above(0.3, -0.2, height)), std::abs(height), 1e-12);
  }
  // Of two triangles with different slopes, the one that the point is over counts.
  const Patch tent = { { Above(-1, -1), Above(1, -1), Above(1, 1, 2) },
    { Above(-1, -1), Above(1, 1, 2), Above(-1, 1) } };
  EXPECT_NEAR(comparison.HeightAbove(tent, Above(0.5, -0.5)), 0.5, 1e-12)
    << "z = 1 + y before the diagonal";
  EXPECT_NEAR(comparison.HeightAbove(tent, Above(-0.5, 0.5)), 0.5, 1e-12) << "z = 1 + x behind it";
}

TEST(PatchComparison, SteepTrianglesAreNotCompared)
{
  PatchComparison comparison;
  const Patch flat = SquarePatch();
  const auto sloped = [](double slope) {
    return Patch{ { Above(0, 0), Above(1, 0, slope), Above(0, 1) } };
  };
  EXPECT_TRUE(comparison.Begin(flat, sloped(4.8))); // a cosine of 0.204
  EXPECT_FALSE(comparison.Begin(flat, sloped(5)));  // 0.196
  EXPECT_FALSE(comparison.Begin(flat, { { Above(0, 0), Above(0, 1), Above(1, 0) } }))
    << "it faces down";
}

TEST(PatchComparison, AFanGoesAroundItsCenterOnce)
{
  PatchComparison comparison;
  const std::vector<Vector3d> border = { Above(1, 0, 0.1), Above(0, 1, -0.1), Above(-1, 0),
    Above(0, -1, 0.2) };
  ASSERT_TRUE(comparison.Begin(SquarePatch(), SquarePatch()));
  for (const Vector3d& center : { Above(0, 0, 0.3), Above(0.4, 0.4) })
  {
    EXPECT_TRUE(comparison.GoAroundOnce(FanPatch(center, border), center));
  }
  const Vector3d outside = Above(0.6, 0.6);
  EXPECT_FALSE(comparison.GoAroundOnce(FanPatch(outside, border), outside));
  // Twice around, and half around.
  std::vector<Vector3d> twice = border;
  twice.insert(twice.end(), border.begin(), border.end());
  EXPECT_FALSE(comparison.GoAroundOnce(FanPatch(Above(0, 0), twice), Above(0, 0)));
  Patch half = FanPatch(Above(0, 0), border);
  half.resize(2);
  EXPECT_FALSE(comparison.GoAroundOnce(half, Above(0, 0)));
}

TEST(PatchComparison, TheCenterMayBeAnyCornerOfItsTriangles)
{
  PatchComparison comparison;
  ASSERT_TRUE(comparison.Begin(SquarePatch(), SquarePatch()));
  Patch fan = FanPatch(Above(0, 0), { Above(1, 0), Above(0, 1), Above(-1, 0), Above(0, -1) });
  for (std::size_t i = 0; i < fan.size(); ++i)
  {
    std::rotate(fan[i].begin(), fan[i].begin() + static_cast<int>(i % 3), fan[i].end());
  }
  EXPECT_TRUE(comparison.GoAroundOnce(fan, Above(0, 0)));
}

TEST(PatchComparison, GapOfSegmentsWhereTheyCross)
{
  PatchComparison comparison;
  ASSERT_TRUE(comparison.Begin(SquarePatch(), SquarePatch()));
  const PatchComparison::Segment low = { Above(-1, 0), Above(1, 0) };
  // It passes over the middle at a height of 1.
  const PatchComparison::Segment high = { Above(0, -1, 0), Above(0, 1, 2) };
  EXPECT_NEAR(comparison.GapAtCrossing(low, high), 1, 1e-12);
  EXPECT_NEAR(comparison.GapAtCrossing(high, low), 1, 1e-12);
  EXPECT_EQ(comparison.GapAtCrossing(low, { Above(2, -1, 1), Above(2, 1, 1) }), 0)
    << "beside each other";
  EXPECT_EQ(comparison.GapAtCrossing(low, { Above(0, 0.5, 1), Above(0, 1, 1) }), 0)
    << "before it is reached";
  EXPECT_EQ(comparison.GapAtCrossing(low, { Above(-1, 1, 1), Above(1, 1, 1) }), 0) << "parallel";
}

TEST(PatchComparison, ThinTrianglesHaveNoShape)
{
  EXPECT_TRUE(PatchComparison::HaveShape(SquarePatch()));
  EXPECT_TRUE(PatchComparison::HaveShape({}));
  const auto needle = [](double height) {
    return std::array<Vector3d, 3>{ Above(0, 0), Above(1, 0), Above(0.5, height) };
  };
  EXPECT_TRUE(PatchComparison::HaveShape({ needle(1.01e-3) }));
  EXPECT_FALSE(PatchComparison::HaveShape({ needle(0.99e-3) }));
  EXPECT_FALSE(PatchComparison::HaveShape({ needle(1), needle(0) }));
}
