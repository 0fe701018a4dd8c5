// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ChainKernels_h
#define freespace_ChainKernels_h

namespace freespace
{

/// The steps of edge detection that are done for every token, one chain at a time.

/// Adds to sum[k] the weighted sum of the 2 * radius + 1 values around values[k].
void AddWeighted(const double* values, int count, const double* weights, int radius, double* sum);

/// The unit direction of (x, y)[k], or that across the gradient (gx, gy)[k] when it has the gradient
/// to its left.
void Directions(const double* x, const double* y, const float* gx, const float* gy, int count,
  double* unitX, double* unitY);

/// Where in memory, counted in bytes, an image of three channels has the pixel at the position
/// moved by a distance along the normal (-ty, tx) of the tangent; the nearest one of the image.
struct ImageLayout
{
  int columns, rows, step; ///< step: bytes from row to row
};
void PixelOffsets(const double* x, const double* y, const double* tx, const double* ty, int count,
  float distance, const ImageLayout& image, int* offsets);

}

#endif
