// SPDX-License-Identifier: BSD-3-Clause
#include "Common/Octant.h"

#include <gtest/gtest.h>

#include <cstdlib>

using namespace freespace;
using Eigen::AlignedBox3d;
using Eigen::Vector3d;

namespace
{

AlignedBox3d RandomBox()
{
  const Vector3d corner = Vector3d::Random();
  AlignedBox3d box(corner);
  return box.extend(Vector3d(Vector3d::Random()));
}

}

TEST(Octant, TheEightFillTheBox)
{
  std::srand(1);
  for (int i = 0; i < 20; ++i)
  {
    const AlignedBox3d box = RandomBox();
    double volume = 0;
    AlignedBox3d joined;
    for (int octant = 0; octant < 8; ++octant)
    {
      const AlignedBox3d part = Octant(box, octant);
      EXPECT_TRUE(box.contains(part));
      EXPECT_NEAR(part.volume(), box.volume() / 8, 1e-15);
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_EQ(part.max()[axis] == box.max()[axis], (octant >> axis & 1) == 1);
      }
      volume += part.volume();
      joined.extend(part);
    }
    EXPECT_NEAR(volume, box.volume(), 1e-14);
    EXPECT_EQ(joined.min(), box.min());
    EXPECT_EQ(joined.max(), box.max());
  }
}

TEST(Octant, OfAPointContainsIt)
{
  std::srand(2);
  for (int i = 0; i < 200; ++i)
  {
    const AlignedBox3d box = RandomBox();
    const Vector3d point = box.sample();
    EXPECT_TRUE(Octant(box, OctantOf(box, point)).contains(point));
  }
}

TEST(Octant, APointBetweenTwoBelongsToTheLower)
{
  const AlignedBox3d box(Vector3d(0, 0, 0), Vector3d(2, 2, 2));
  EXPECT_EQ(OctantOf(box, Vector3d(1, 1, 1)), 0);
  EXPECT_EQ(OctantOf(box, Vector3d(1, 1.5, 1)), 2);
  EXPECT_EQ(OctantOf(box, box.max()), 7);
  EXPECT_EQ(OctantOf(box, box.min()), 0);
}
