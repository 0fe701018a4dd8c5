// SPDX-License-Identifier: BSD-3-Clause
#include "Edges/LargeVector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

using namespace freespace;

TEST(LargeVector, HoldsWhatAVectorHolds)
{
  LargeVector<int> large;
  std::vector<int> plain;
  for (int k = 0; k < 1000000; ++k) // several megabytes, grown step by step
  {
    large.push_back(k);
    plain.push_back(k);
  }
  EXPECT_TRUE(std::equal(large.begin(), large.end(), plain.begin(), plain.end()));
  LargeVector<int> copy = large, moved = std::move(large);
  EXPECT_EQ(copy, moved);
  EXPECT_TRUE(LargeVector<double>().empty());
}
