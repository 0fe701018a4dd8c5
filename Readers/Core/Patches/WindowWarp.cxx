// SPDX-License-Identifier: BSD-3-Clause
#include "Patches/WindowWarp.h"

#include "Common/VectorClones.h"

#include <algorithm>
#include <numeric>

namespace freespace
{

namespace
{

using Values = WindowPixels::Values;
constexpr int Lanes = WindowPixels::Lanes;
using Sum = std::array<float,
  Lanes>; // one of each lane, so that the order of additions is the same everywhere

float Total(const Sum& sum)
{
  return std::accumulate(sum.begin(), sum.end(), 0.0f);
}

// Where the plane has the pixels, and how they move with disparity. Returns how many are outside.
FREESPACE_VECTOR_CLONES
int Project(int padded, const float* column, const float* row, const PlaneWarp& warp, float right,
  float bottom, float* __restrict x, float* __restrict y, float* __restrict dx,
  float* __restrict dy)
{
  const float ox = warp.origin[0], oy = warp.origin[1], oz = warp.origin[2];
  const float cx = warp.alongColumn[0], cy = warp.alongColumn[1], cz = warp.alongColumn[2];
  const float rx = warp.alongRow[0], ry = warp.alongRow[1], rz = warp.alongRow[2];
  const float ex = warp.perDisparity[0], ey = warp.perDisparity[1], ez = warp.perDisparity[2];
  int outside = 0;
  for (int i = 0; i < padded; ++i)
  {
    const float inverse = 1 / (oz + column[i] * cz + row[i] * rz);
    x[i] = (ox + column[i] * cx + row[i] * rx) * inverse;
    y[i] = (oy + column[i] * cy + row[i] * ry) * inverse;
    // A greater disparity moves a point towards the epipole.
    dx[i] = (ex - x[i] * ez) * inverse;
    dy[i] = (ey - y[i] * ez) * inverse;
    outside +=
      (inverse > 0) & (x[i] >= 0.5f) & (y[i] >= 0.5f) & (x[i] < right) & (y[i] < bottom) ? 0 : 1;
  }
  return outside;
}

FREESPACE_VECTOR_CLONES
void Interpolate(int padded, const float* image, int stride, int lastLeft, int lastTop,
  const float* x, const float* y, const float* dx, const float* dy, float* __restrict values,
  float* __restrict slopes)
{
  for (int i = 0; i < padded; ++i)
  {
    const float atX = x[i] - 0.5f, atY = y[i] - 0.5f;
    const int left = std::min(static_cast<int>(atX), lastLeft);
    const int top = std::min(static_cast<int>(atY), lastTop);
    const float fx = atX - static_cast<float>(left), fy = atY - static_cast<float>(top);
    const int upper = top * stride + left, lower = upper + stride;
    const float upperLeft = image[upper], lowerLeft = image[lower];
    const float upperStep = image[upper + 1] - upperLeft, lowerStep = image[lower + 1] - lowerLeft;
    const float down = lowerLeft + fx * lowerStep - (upperLeft + fx * upperStep);
    values[i] = upperLeft + fx * upperStep + fy * down;
    slopes[i] = (upperStep + fy * (lowerStep - upperStep)) * dx[i] + down * dy[i];
  }
}

FREESPACE_VECTOR_CLONES
void AddMoments(int padded, const float* isPixel, const float* values, const float* slopes,
  const float* reference, float* __restrict sums)
{
  for (int i = 0; i < padded; i += Lanes)
  {
    for (int k = 0; k < Lanes; ++k)
    {
      const float value = isPixel[i + k] * values[i + k];
      sums[k] += value;
      sums[Lanes + k] += value * value;
      sums[2 * Lanes + k] += value * reference[i + k];
      sums[3 * Lanes + k] += isPixel[i + k] * slopes[i + k];
    }
  }
}

FREESPACE_VECTOR_CLONES
void AddSums(int padded, const WindowPixels& window, const float* values, const float* slopes,
  const float* reference, const float* weights, float gain, float mean, float slopeMean,
  float* __restrict sums)
{
  for (int i = 0; i < padded; i += Lanes)
  {
    for (int k = 0; k < Lanes; ++k)
    {
      const float column = window.column[i + k], row = window.row[i + k];
      const float slope = gain * (slopes[i + k] - slopeMean);
      const float residual = gain * (values[i + k] - mean) - reference[i + k];
      const float weighted = weights[i + k] * slope;
      const float s = weighted * slope, r = weighted * residual;
      sums[k] += s;
      sums[Lanes + k] += s * column;
      sums[2 * Lanes + k] += s * row;
      sums[3 * Lanes + k] += s * column * column;
      sums[4 * Lanes + k] += s * column * row;
      sums[5 * Lanes + k] += s * row * row;
      sums[6 * Lanes + k] += r;
      sums[7 * Lanes + k] += r * column;
      sums[8 * Lanes + k] += r * row;
      sums[9 * Lanes + k] += weights[i + k] * residual * residual;
    }
  }
}

}

WindowPixels::WindowPixels(int radius)
{
  this->column.fill(0);
  this->row.fill(0);
  this->isPixel.fill(0);
  for (int y = -radius; y <= radius; ++y)
  {
    for (int x = -radius; x <= radius; ++x, ++this->count)
    {
      const std::size_t i = static_cast<std::size_t>(this->count);
      this->column[i] = static_cast<float>(x);
      this->row[i] = static_cast<float>(y);
      this->isPixel[i] = 1;
    }
  }
  this->padded = (this->count + Lanes - 1) / Lanes * Lanes;
}

bool WarpWindow(const WindowPixels& window, const PlaneWarp& warp, const cv::Mat1f& image,
  Values& values, Values& slopes)
{
  Values x, y, dx, dy;
  const float right = static_cast<float>(image.cols) - 0.5f;
  const float bottom = static_cast<float>(image.rows) - 0.5f;
  if (Project(window.padded, window.column.data(), window.row.data(), warp, right, bottom, x.data(),
        y.data(), dx.data(), dy.data()) > 0)
  {
    return false;
  }
  Interpolate(window.padded, image[0], static_cast<int>(image.step1()), image.cols - 2,
    image.rows - 2, x.data(), y.data(), dx.data(), dy.data(), values.data(), slopes.data());
  return true;
}

WindowMoments MomentsOf(
  const WindowPixels& window, const Values& values, const Values& slopes, const Values& reference)
{
  std::array<Sum, 4> sums{};
  AddMoments(window.padded, window.isPixel.data(), values.data(), slopes.data(), reference.data(),
    sums.front().data());
  return { Total(sums[0]), Total(sums[1]), Total(sums[2]), Total(sums[3]) };
}

WindowSums SumWindow(const WindowPixels& window, const Values& values, const Values& slopes,
  const Values& reference, const Values& weights, float gain, float mean, float slopeMean)
{
  std::array<Sum, 10> sums{};
  AddSums(window.padded, window, values.data(), slopes.data(), reference.data(), weights.data(),
    gain, mean, slopeMean, sums.front().data());
  return { Total(sums[0]), Total(sums[1]), Total(sums[2]), Total(sums[3]), Total(sums[4]),
    Total(sums[5]), Total(sums[6]), Total(sums[7]), Total(sums[8]), Total(sums[9]) };
}

}
