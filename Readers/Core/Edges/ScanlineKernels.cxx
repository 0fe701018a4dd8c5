// SPDX-License-Identifier: BSD-3-Clause
#include "Edges/ScanlineKernels.h"

#include "Common/VectorClones.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

namespace
{

// Beyond its ends, the last values of a row are repeated.
FREESPACE_INLINE void Continue(float* row, int width, int radius)
{
  std::fill(row - radius, row, row[0]);
  std::fill(row + width, row + width + radius, row[width - 1]);
}

// A radius known at compile time keeps the sums in registers.
template <int radius>
FREESPACE_INLINE void SmoothBy(const std::uint8_t* const* rows, const float* weights, int width,
  float* __restrict middle, float* __restrict smooth)
{
  for (int x = 0; x < width; ++x)
  {
    float sum = weights[0] * static_cast<float>(rows[radius][x]);
    for (int k = 1; k <= radius; ++k)
    {
      sum += weights[k] * static_cast<float>(rows[radius - k][x] + rows[radius + k][x]);
    }
    middle[x] = sum;
  }
  Continue(middle, width, radius);
  for (int x = 0; x < width; ++x)
  {
    float sum = weights[0] * middle[x];
    for (int k = 1; k <= radius; ++k)
    {
      sum += weights[k] * (middle[x - k] + middle[x + k]);
    }
    smooth[x] = sum;
  }
}

// Any other radius, weight by weight.
FREESPACE_INLINE void SmoothByAny(const std::uint8_t* const* rows, const float* weights, int radius,
  int width, float* __restrict middle, float* __restrict smooth)
{
  for (int k = 0; k <= radius; ++k)
  {
    const std::uint8_t *above = rows[radius - k], *below = rows[radius + k];
    const float weight = k == 0 ? 0.5f * weights[0] : weights[k];
    for (int x = 0; x < width; ++x)
    {
      middle[x] = (k == 0 ? 0 : middle[x]) + weight * static_cast<float>(above[x] + below[x]);
    }
  }
  Continue(middle, width, radius);
  for (int k = 0; k <= radius; ++k)
  {
    const float weight = k == 0 ? 0.5f * weights[0] : weights[k];
    for (int x = 0; x < width; ++x)
    {
      smooth[x] = (k == 0 ? 0 : smooth[x]) + weight * (middle[x - k] + middle[x + k]);
    }
  }
}

}

FREESPACE_VECTOR_CLONES
void SmoothRow(const std::uint8_t* const* rows, const float* weights, int radius, int width,
  float* work, float* smooth)
{
  float* middle = work + radius;
  switch (radius)
  {
    case 2:
      return SmoothBy<2>(rows, weights, width, middle, smooth);
    case 3:
      return SmoothBy<3>(rows, weights, width, middle, smooth);
    case 4:
      return SmoothBy<4>(rows, weights, width, middle, smooth);
    default:
      return SmoothByAny(rows, weights, radius, width, middle, smooth);
  }
}

FREESPACE_VECTOR_CLONES
void SlopeRow(const float* above, const float* here, const float* below, int width,
  float* __restrict gx, float* __restrict gy, float* __restrict squared)
{
  for (int x = 1; x < width - 1; ++x)
  {
    const float dx = 0.5f * (here[x + 1] - here[x - 1]);
    const float dy = 0.5f * (below[x] - above[x]);
    gx[x] = dx;
    gy[x] = dy;
    squared[x] = dx * dx + dy * dy;
  }
}

FREESPACE_VECTOR_CLONES
void MarkPeaks(
  const PeakRows& rows, int width, float scale, float offset, std::uint8_t* __restrict marks)
{
  const float *above = rows.above, *here = rows.here, *below = rows.below;
  const float *gx = rows.gx, *gy = rows.gy, *grey = rows.grey;
  for (int x = 1; x < width - 1; ++x)
  {
    const float slope = here[x];
    // Without branches, so that the loop is vectorized.
    const bool alongX = std::abs(gx[x]) >= std::abs(gy[x]);
    const float left = here[x - 1], right = here[x + 1], up = above[x], down = below[x];
    const float before = alongX ? left : up;
    const float after = alongX ? right : down;
    const bool steep = slope >= scale * (grey[x] + offset);
    marks[x] = static_cast<std::uint8_t>(steep & (slope > before) & (slope >= after));
  }
}

FREESPACE_VECTOR_CLONES
void SumOfThree(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below,
  int count, std::uint16_t* __restrict sum)
{
  for (int i = 0; i < count; ++i)
  {
    sum[i] = static_cast<std::uint16_t>(above[i] + here[i] + below[i]);
  }
}

FREESPACE_VECTOR_CLONES
void MeanOfNine(const std::uint16_t* sum, int count, std::uint8_t* __restrict mean)
{
  constexpr std::uint16_t ninth = 65536 / 9 + 1, half = 4;
  for (int i = 0; i < count; ++i)
  {
    const std::uint16_t nine = static_cast<std::uint16_t>(sum[i - 3] + sum[i] + sum[i + 3] + half);
    mean[i] = static_cast<std::uint8_t>(static_cast<std::uint32_t>(nine) * ninth >> 16);
  }
}

}
