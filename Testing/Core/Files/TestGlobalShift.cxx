// SPDX-License-Identifier: BSD-3-Clause
#include "Files/GlobalShift.h"

#include <gtest/gtest.h>

#include <random>

using namespace freespace;
using Eigen::AlignedBox3d;
using Eigen::Vector3d;

TEST(GlobalShift, IsZeroWhereSinglePrecisionSuffices)
{
  EXPECT_TRUE(SuggestGlobalShift(AlignedBox3d()).isZero(0));
  EXPECT_TRUE(SuggestGlobalShift({ Vector3d(-3, 10, 100), Vector3d(4, 11, 120) }).isZero(0));
  // 100,000 units with steps of 1/128: 0.004 of rounding is 1e-5 of 400.
  EXPECT_TRUE(SufficesSingle({ Vector3d(100000, 0, 0), Vector3d(100700, 0, 0) }));
  EXPECT_FALSE(SufficesSingle({ Vector3d(100000, 0, 0), Vector3d(100500, 0, 0) }));
  EXPECT_FALSE(SufficesSingle({ Vector3d(0, 0, 0), Vector3d(1e39, 0, 0) }));
}

TEST(GlobalShift, IsARoundNumberNearTheMiddle)
{
  const AlignedBox3d box(Vector3d(499990, 5399980, 290), Vector3d(500020, 5400030, 310));
  EXPECT_EQ(SuggestGlobalShift(box), Vector3d(500000, 5400000, 300));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-1e7, 1e7), length(-2, 2);
  for (int i = 0; i < 1000; ++i)
  {
    const Vector3d low(place(random), place(random), place(random));
    const Vector3d size = Vector3d::Constant(std::pow(10, length(random)));
    const AlignedBox3d at(low, low + size);
    const Vector3d shift = SuggestGlobalShift(at);
    ASSERT_TRUE(SufficesSingle({ at.min() - shift, at.max() - shift })) << low.transpose();
  }
}

TEST(GlobalShift, TheCommentKeepsEveryDigit)
{
  EXPECT_EQ(GlobalShiftComment(Vector3d::Zero()), "");
  EXPECT_EQ(GlobalShiftComment(Vector3d(500000, -5.25, 0)), "global shift 500000 -5.25 0");
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> number(-1e7, 1e7);
  for (int i = 0; i < 1000; ++i)
  {
    const Vector3d shift(number(random), number(random), 1e-9 * number(random));
    const auto read = GlobalShiftFromComment(GlobalShiftComment(shift));
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, shift);
  }
}

TEST(GlobalShift, OtherCommentsHaveNone)
{
  for (const char* comment : { "", "global shift", "global shift 1 2", "global shift 1 2 3 4",
         "global shift 1 2 x", "global shift 1 2 nan", "global shift 1 2 1e999",
         "global shift1 2 3", "a global shift 1 2 3", "VTK" })
  {
    EXPECT_FALSE(GlobalShiftFromComment(comment)) << comment;
  }
  EXPECT_EQ(*GlobalShiftFromComment("global shift 1  2 3 "), Vector3d(1, 2, 3));
}
