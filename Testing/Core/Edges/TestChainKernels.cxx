// SPDX-License-Identifier: BSD-3-Clause
// What is done for many tokens at once, held against one after the other.
#include "Edges/ChainKernels.h"

#include "Support/Core/RandomValues.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace freespace;

TEST(ChainKernels, OffsetsStayInTheImage)
{
  RandomValues random(9);
  const ImageLayout image{ 40, 30, 120 };
  for (int count : Widths)
  {
    const auto x = random.Next<double>(count, -3, 43), y = random.Next<double>(count, -3, 33),
               angle = random.Next<double>(count, -3, 3);
    const auto gx = random.Next<float>(count, 1, 2), gy = random.Next<float>(count, 1, 2);
    std::vector<double> ax(count), ay(count), tx(count), ty(count);
    for (int k = 0; k < count; ++k)
    {
      ax[k] = 3 * std::cos(angle[k]);
      ay[k] = 3 * std::sin(angle[k]);
    }
    Directions(ax.data(), ay.data(), gx.data(), gy.data(), count, tx.data(), ty.data());
    std::vector<int> offsets(count);
    PixelOffsets(x.data(), y.data(), tx.data(), ty.data(), count, 2.5f, image, offsets.data());
    for (int k = 0; k < count; ++k)
    {
      // The gradient lies to the right.
      const bool ahead = ax[k] * gy[k] - ay[k] * gx[k] > 0;
      const double length = ahead ? 3 : std::hypot(static_cast<double>(gx[k]), gy[k]);
      EXPECT_NEAR(tx[k], (ahead ? ax[k] : gy[k]) / length, 1e-12);
      EXPECT_NEAR(ty[k], (ahead ? ay[k] : -gx[k]) / length, 1e-12);
      const int column = std::clamp(static_cast<int>(x[k] - 2.5 * ty[k]), 0, 39);
      const int row = std::clamp(static_cast<int>(y[k] + 2.5 * tx[k]), 0, 29);
      EXPECT_EQ(offsets[k], 120 * row + 3 * column);
    }
  }
}
