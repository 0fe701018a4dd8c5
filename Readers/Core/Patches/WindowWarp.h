// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_WindowWarp_h
#define freespace_WindowWarp_h

#include <opencv2/core.hpp>

#include <array>

namespace freespace
{

/// The pixels of a square window, row by row, padded with pixels that count nothing to whole groups of lanes, so
/// that processors take several at once.
struct WindowPixels
{
  static constexpr int Lanes = 8;
  static constexpr int MostPixels = 15 * 15;
  static constexpr int Capacity = (MostPixels + Lanes - 1) / Lanes * Lanes;
  using Values = std::array<float, Capacity>;

  /// radius: in [1, 7].
  explicit WindowPixels(int radius);

  int count = 0;      ///< pixels
  int padded = 0;     ///< the same, to whole groups
  Values column, row; ///< of each pixel, from the middle one
  Values isPixel;     ///< 1, and 0 for the padding
};

/// How a plane carries the window into another image, in homogeneous coordinates that are linear in the
/// window's columns and rows: at (c, r) it is origin + c * alongColumn + r * alongRow.
struct PlaneWarp
{
  std::array<float, 3> origin, alongColumn, alongRow;
  std::array<float, 3> perDisparity; ///< what the same homogeneous coordinates gain by disparity
};

/// Reads an image's grey levels where a plane has the window's pixels, by bilinear interpolation, and their
/// slopes against disparity. False where one of them lies outside the image.
bool WarpWindow(const WindowPixels& window, const PlaneWarp& warp, const cv::Mat1f& image,
  WindowPixels::Values& values, WindowPixels::Values& slopes);

/// Sums over a window.
struct WindowMoments
{
  float value = 0, square = 0, product = 0, slope = 0;
};

/// Of an image's values, their squares, their products with the reference's, and of their slopes.
WindowMoments MomentsOf(const WindowPixels& window, const WindowPixels::Values& values,
  const WindowPixels::Values& slopes, const WindowPixels::Values& reference);

/// Weighted sums for the normal equations of a plane: s is the square of the slope, r the product of slope and
/// residual, followed by the window's coordinates (column, row) that they are multiplied by.
struct WindowSums
{
  float s = 0, sc = 0, sr = 0, scc = 0, scr = 0, srr = 0;
  float r = 0, rc = 0, rr = 0;
  float residuals = 0; ///< squares
};

/// Of residuals gain * (value - mean) - reference and slopes gain * (slope - slopeMean).
WindowSums SumWindow(const WindowPixels& window, const WindowPixels::Values& values,
  const WindowPixels::Values& slopes, const WindowPixels::Values& reference,
  const WindowPixels::Values& weights, float gain, float mean, float slopeMean);

}

#endif
