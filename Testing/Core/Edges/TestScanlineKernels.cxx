// SPDX-License-Identifier: BSD-3-Clause
// What is done for many pixels at once, held against one after the other.
#include "Edges/ScanlineKernels.h"

#include "Support/Core/RandomValues.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

using namespace freespace;

TEST(ScanlineKernels, SmoothAsTheSumOfWeightsForEveryRadius)
{
  RandomValues random(3);
  for (int width : Widths)
  {
    for (int radius = 1; radius <= 7; ++radius)
    {
      std::vector<std::vector<std::uint8_t>> images;
      std::vector<const std::uint8_t*> rows;
      for (int k = 0; k <= 2 * radius; ++k)
      {
        images.push_back(random.Next<std::uint8_t>(width, 0, 255.9));
      }
      std::transform(images.begin(), images.end(), std::back_inserter(rows),
        [](const std::vector<std::uint8_t>& image) { return image.data(); });
      const std::vector<float> weights = random.Next<float>(radius + 1, 0, 0.2);
      std::vector<float> work(width + 2 * radius), smooth(width, -1.0f);
      SmoothRow(rows.data(), weights.data(), radius, width, work.data(), smooth.data());
      for (int x = 0; x < width; ++x)
      {
        double expected = 0;
        for (int i = -radius; i <= radius; ++i)
        {
          for (int j = -radius; j <= radius; ++j)
          {
            expected += static_cast<double>(weights[std::abs(i)]) * weights[std::abs(j)] *
              images[radius + j][std::clamp(x + i, 0, width - 1)];
          }
        }
        EXPECT_NEAR(smooth[x], expected, 1e-5 * expected + 1e-4) << width << " " << radius;
      }
    }
  }
}

TEST(ScanlineKernels, MarkWhatIsSteepestAcrossTheEdge)
{
  RandomValues random(5);
  int marked = 0;
  for (int width : Widths)
  {
    const auto above = random.Next<float>(width, 0, 9), here = random.Next<float>(width, 0, 9),
               below = random.Next<float>(width, 0, 9), grey = random.Next<float>(width, 0, 255);
    std::vector<float> gx(width, 0.0f), gy(width, 0.0f), squared(width, -1.0f);
    SlopeRow(above.data(), here.data(), below.data(), width, gx.data(), gy.data(), squared.data());
    std::vector<std::uint8_t> marks(width, 0);
    MarkPeaks({ above.data(), here.data(), below.data(), gx.data(), gy.data(), grey.data() }, width,
      0.02f, 8, marks.data());
    for (int x = 1; x + 1 < width; ++x)
    {
      EXPECT_EQ(gx[x], 0.5f * (here[x + 1] - here[x - 1]));
      EXPECT_EQ(gy[x], 0.5f * (below[x] - above[x]));
      EXPECT_FLOAT_EQ(squared[x], gx[x] * gx[x] + gy[x] * gy[x]);
      const bool alongX = std::abs(gx[x]) >= std::abs(gy[x]);
      const float before = alongX ? here[x - 1] : above[x];
      const float after = alongX ? here[x + 1] : below[x];
      const bool expected =
        here[x] >= 0.02f * (grey[x] + 8) && here[x] > before && here[x] >= after;
      EXPECT_EQ(marks[x] != 0, expected) << width << " " << x;
      marked += expected;
    }
    EXPECT_EQ(marks.front() + marks.back(), 0);
    EXPECT_EQ(squared.front(), -1.0f);
    EXPECT_EQ(squared.back(), -1.0f);
  }
  EXPECT_GT(marked, 30);
}

TEST(ScanlineKernels, MeansOfNineAreRounded)
{
  RandomValues random(7);
  for (int width : Widths)
  {
    const int count = 3 * width;
    const auto above = random.Next<std::uint8_t>(count, 0, 255.9),
               here = random.Next<std::uint8_t>(count, 0, 255.9),
               below = random.Next<std::uint8_t>(count, 0, 255.9);
    std::vector<std::uint16_t> sums(count + 6, 0);
    SumOfThree(above.data(), here.data(), below.data(), count, sums.data() + 3);
    std::vector<std::uint8_t> means(count);
    MeanOfNine(sums.data() + 3, count, means.data());
    for (int i = 0; i < count; ++i)
    {
      ASSERT_EQ(sums[i + 3], above[i] + here[i] + below[i]);
      EXPECT_EQ(means[i], (sums[i] + sums[i + 3] + sums[i + 6] + 4) / 9);
    }
  }
}
