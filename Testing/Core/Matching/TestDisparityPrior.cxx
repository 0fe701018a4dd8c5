// SPDX-License-Identifier: BSD-3-Clause
#include "Matching/DisparityPrior.h"

#include <gtest/gtest.h>

using namespace freespace;

TEST(DisparityPrior, NothingIsKnownWithoutMatches)
{
  const DisparityPrior prior({}, {});
  EXPECT_EQ(prior.At({ 0, 0 }), 0);
  EXPECT_EQ(prior.At({ 1e6, -5 }), 0);
}

TEST(DisparityPrior, OneMatchIsExpectedEverywhere)
{
  const DisparityPrior prior({ { 100, 200 } }, { 0.25 });
  for (const Eigen::Vector2d& pixel : { Eigen::Vector2d(0, 0), Eigen::Vector2d(100, 200),
         Eigen::Vector2d(1e5, 1e5), Eigen::Vector2d(-3, 40) })
  {
    EXPECT_EQ(prior.At(pixel), 0.25);
  }
}

TEST(DisparityPrior, TheMedianOfACell)
{
  // All in the cell [16, 32) x [0, 16).
  const DisparityPrior prior(
    { { 17, 1 }, { 20, 5 }, { 31.9, 15.9 }, { 25, 3 }, { 18, 9 } }, { 0.5, 0.1, 9.0, 0.2, 0.3 });
  EXPECT_EQ(prior.At({ 24, 8 }), 0.3);
}

TEST(DisparityPrior, AnEmptyCellTakesTheNearest)
{
  // A row of ten cells with matches in the first and the last.
  const DisparityPrior prior({ { 1, 1 }, { 159, 1 } }, { 1.0, 2.0 });
  for (int cell = 0; cell < 10; ++cell)
  {
    EXPECT_EQ(prior.At({ 16 * cell + 8.0, 8 }), cell < 5 ? 1.0 : 2.0) << cell;
  }
}
