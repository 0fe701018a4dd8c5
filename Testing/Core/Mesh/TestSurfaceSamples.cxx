// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Distance/SurfaceSamples.h"

#include <gtest/gtest.h>

using namespace freespace;

TEST(SurfaceSamples, AreSpreadByArea)
{
  // A square of two triangles, and one that is three times as large as either of them.
  const TriangleMesh mesh = { { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { -3, 0, 0 } },
    { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 4 } } };
  int counts[3] = {};
  for (const SurfaceSample& sample : SampleSurface(mesh, 5000))
  {
    ++counts[sample.triangle];
    EXPECT_EQ(sample.point.x() <= 0, sample.triangle == 2);
  }
  EXPECT_NEAR(counts[0], 1000, 1);
  EXPECT_NEAR(counts[1], 1000, 1);
  EXPECT_NEAR(counts[2], 3000, 1);
}
