// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/FreespaceQueries.h"

#include "Support/PlainSettings.h"
#include "Support/RandomMaps.h"

#include <gtest/gtest.h>

using namespace freespace;
using Eigen::AlignedBox3d;
using Eigen::Vector3d;

namespace
{

FreespaceUnion MakeUnion(unsigned int seed)
{
  auto options = Plain(FreespaceUnionOptions());
  options.minimumViews = 1 + seed % 2;
  return FreespaceUnion(RandomMaps(seed, 2 + seed % 4), options);
}

}

TEST(FreespaceQueries, SegmentsAreBlockedWhereTheirPointsAre)
{
  int blocked = 0, free = 0, late = 0;
  for (unsigned int seed = 0; seed < 30; ++seed)
  {
    const FreespaceUnion phi = MakeUnion(seed);
    for (int i = 0; i < 50; ++i)
    {
      const Vector3d first = 2.0 * Vector3d::Random(), last = 2.0 * Vector3d::Random();
      const double found = FirstBlocked(phi, first, last);
      double stepped = HUGE_VAL;
      for (int j = 0; j <= 2000 && stepped > 1; ++j)
      {
        stepped = phi.IsFree(first + j / 2000.0 * (last - first)) ? stepped : j / 2000.0;
      }
      // Between its steps the march can miss a sliver, which the exact answer does not.
      ASSERT_LE(found, stepped + 1e-9);
      if (found < 1)
      {
        const Vector3d at = first + found * (last - first);
        EXPECT_TRUE(found > 0
            ? std::abs(phi.Value(at)) < 1e-6 || !phi.IsFree(at + 1e-7 * (last - first))
            : !phi.IsFree(first));
        EXPECT_TRUE(found < 1e-7 || phi.IsFree(first + (found - 1e-7) * (last - first)));
      }
      blocked += stepped < 1;
      free += found > 1;
      late += found < 1 && stepped - found > 1.0 / 2000;
    }
  }
  EXPECT_GT(blocked, 300);
  EXPECT_GT(free, 100);
  EXPECT_LT(late, 50);
}

TEST(FreespaceQueries, BoxesAndSpheresAreFreeOnlyWhereAllTheirPointsAre)
{
  int free = 0, refused = 0, blocked = 0;
  for (unsigned int seed = 0; seed < 20; ++seed)
  {
    const FreespaceUnion phi = MakeUnion(seed);
    for (int i = 0; i < 60; ++i)
    {
      const Vector3d center = 1.6 * Vector3d::Random();
      const double radius = 0.02 + 0.15 * (i % 5);
      const AlignedBox3d box(center - Vector3d(radius, 0.5 * radius, radius),
        center + Vector3d(radius, 0.5 * radius, radius));
      bool boxIsFree = true, sphereIsFree = true;
      for (int j = 0; j < 2000; ++j)
      {
        boxIsFree = boxIsFree && phi.IsFree(box.sample());
        const Vector3d offset = Vector3d::Random();
        sphereIsFree = sphereIsFree && (offset.norm() > 1 || phi.IsFree(center + radius * offset));
      }
      const bool box1 = IsBoxFree(phi, box), sphere1 = IsSphereFree(phi, center, radius);
      ASSERT_TRUE(boxIsFree || !box1);
      ASSERT_TRUE(sphereIsFree || !sphere1);
      free += box1 + sphere1;
      refused += (boxIsFree && !box1) + (sphereIsFree && !sphere1);
      blocked += !boxIsFree + !sphereIsFree;
    }
  }
  EXPECT_GT(free, 300);
  EXPECT_GT(blocked, 300);
  EXPECT_LT(refused, free / 5);
}

TEST(FreespaceQueries, WhatIsNotFiniteIsNotFree)
{
  const FreespaceUnion phi(RandomMaps(3, 2), {});
  const FreespaceUnion empty({}, {});
  const Vector3d far = Vector3d::Constant(100);
  ASSERT_TRUE(IsSphereFree(phi, far, 1));
  for (const double number : { std::nan(""), HUGE_VAL, -HUGE_VAL })
  {
    for (const FreespaceUnion* field : { &phi, &empty })
    {
      EXPECT_FALSE(IsSphereFree(*field, far, number));
      EXPECT_EQ(FirstBlocked(*field, far, Vector3d(number, 0, 0)), 0.0);
      for (int axis = 0; axis < 3; ++axis)
      {
        Vector3d point = far;
        point[axis] = number;
        EXPECT_FALSE(IsSphereFree(*field, point, 1));
        EXPECT_FALSE(IsBoxFree(*field, AlignedBox3d(point, far)));
        EXPECT_FALSE(IsBoxFree(*field, AlignedBox3d(far, point)));
      }
    }
  }
  EXPECT_FALSE(IsSphereFree(phi, far, -1));
}

TEST(FreespaceQueries, AwkwardInput)
{
  const FreespaceUnion empty({}, {});
  const Vector3d o = Vector3d::Zero(), x = Vector3d::UnitX();
  EXPECT_EQ(FirstBlocked(empty, o, x), HUGE_VAL);
  EXPECT_TRUE(IsBoxFree(empty, AlignedBox3d(o, x)));
  EXPECT_TRUE(IsSphereFree(empty, o, 1));
  const FreespaceUnion phi(RandomMaps(3, 2), {});
  // Segments, boxes and balls without extent are points.
  for (int i = 0; i < 200; ++i)
  {
    const Vector3d p = 1.5 * Vector3d::Random();
    EXPECT_EQ(FirstBlocked(phi, p, p) > 1, phi.IsFree(p));
    EXPECT_EQ(IsSphereFree(phi, p, 0.0), phi.IsFree(p));
    EXPECT_EQ(IsBoxFree(phi, AlignedBox3d(p, p)), phi.IsFree(p));
  }
}
