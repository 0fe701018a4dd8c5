// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ScanlineKernels_h
#define freespace_ScanlineKernels_h

#include <cstdint>
#include <vector>

namespace freespace
{

/// The steps of edge detection that are done for every pixel, one row at a time.

/// Smooths a row of grey levels by a symmetric kernel. `rows` are those from `radius` above to
/// `radius` below, `weights` the kernel from its middle outwards. Beyond the row's ends, the last
/// pixels are repeated. `work` has room for width + 2 * radius values.
void SmoothRow(const std::uint8_t* const* rows, const float* weights, int radius, int width,
  float* work, float* smooth);

/// Central differences of smoothed grey levels and the squared slope. The first and the last pixel
/// are left alone.
void SlopeRow(const float* above, const float* here, const float* below, int width, float* gx,
  float* gy, float* squared);

/// Marks the pixels of a row where the slope is greatest across the edge and, squared, at least
/// scale * (grey + offset): nonzero in `marks`. The first and the last pixel are left alone.
struct PeakRows
{
  const float *above, *here, *below; ///< squared slopes
  const float *gx, *gy, *grey;       ///< of the row itself
};
void MarkPeaks(const PeakRows& rows, int width, float scale, float offset, std::uint8_t* marks);

/// Sums of three rows, value by value.
void SumOfThree(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below,
  int count, std::uint16_t* sum);

/// A ninth, rounded, of three neighbouring sums, which are three values apart: sum[i - 3], sum[i]
/// and sum[i + 3].
void MeanOfNine(const std::uint16_t* sum, int count, std::uint8_t* mean);

}

#endif
