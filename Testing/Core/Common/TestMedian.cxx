// SPDX-License-Identifier: BSD-3-Clause
#include "Common/Median.h"

#include <gtest/gtest.h>

#include <random>

using namespace freespace;

TEST(Median, IsTheValueOfMiddleRank)
{
  std::mt19937 random(1);
  for (std::size_t count = 1; count < 30; ++count)
  {
    std::vector<double> values(count);
    std::generate(values.begin(), values.end(), [&] { return random() % 10 * 0.5; });
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(Median(values), sorted[count / 2]);
  }
}

TEST(Median, OfAnEvenNumberIsTheUpperOfTheMiddleTwo)
{
  EXPECT_EQ(Median(std::vector<int>{ 4, 1, 3, 2 }), 3);
  EXPECT_EQ(Median(std::vector<int>{ 2, 1 }), 2);
  EXPECT_EQ(Median(std::vector<int>{ 7 }), 7);
}
