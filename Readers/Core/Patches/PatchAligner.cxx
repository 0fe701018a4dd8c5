// SPDX-License-Identifier: BSD-3-Clause
#include "Patches/PatchAligner.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

// Of the grey levels, standard deviation.
constexpr double Noise = 0.5;

// How well the place of a pattern is known at best, pixels: sampling and cameras are not exact. Steep grey
// levels are less certain for it.
constexpr double PlaceDeviation = 0.1;

// Images are smoothed and interpolated, so that a window has fewer independent values than pixels.
constexpr double PixelsPerValue = 2.5;

// Of the Gaussian with which pixels count less towards the rim of a window, as a fraction of its radius.
constexpr double Falloff = 0.72;

// Standard deviation of the tangent of a plane's turn: how well its slope is known beforehand.
constexpr double SlopeDeviation = 0.7;

// A partner that correlates less with the reference shows something else.
constexpr double LeastCorrelation = 0.3;

// A plane whose window moves less in every partner has converged, pixels.
constexpr double Still = 0.03;

// The middle of a window, in which it must have contrast: otherwise an edge at its rim would put a feature
// where nothing is known.
constexpr int MiddleRadius = 2;
constexpr double MiddleShare = 0.4; // of the whole window's contrast

double Deviation(double sum, double squares, double count)
{
  const double mean = sum / count;
  return std::sqrt(std::max(0.0, squares / count - mean * mean));
}

}

// A square of pixels of the reference around the one that holds the plane's, row by row.
struct PatchAligner::Window
{
  int radius = 0;
  Vector2d center;     // of the middle pixel, in pixels of the camera
  Values values;       // zero mean
  Values weights;      // of squared residuals
  double contrast = 0; // standard deviation
};

// Normal equations in disparity and slope.
struct PatchAligner::Equations
{
  Matrix3d normal = Matrix3d::Zero();
  Vector3d right = Vector3d::Zero();
  double residuals = 0; // sum of squares
  double weight = 0;    // of the partners
  double correlation = 0;
  int good = 0; // partners that correlate well
};

PatchAligner::PatchAligner(const Image& reference, const std::vector<Image>& partners, double scale,
  const PatchOptions& options)
  : Reference(reference.grey)
  , FocalLength(reference.camera.K(0, 0))
  , Scale(scale)
  , Options(options)
{
  const Matrix3d toScale = Vector3d(scale, scale, 1).asDiagonal();
  for (const Image& image : partners)
  {
    const Camera& camera = image.camera;
    const Matrix3d K = toScale * camera.K;
    const Matrix3d R = camera.R * reference.camera.R.transpose();
    this->Partners.push_back({ K * R * reference.camera.K.inverse(),
      K * (camera.t - R * reference.camera.t), image.grey });
  }
}

bool PatchAligner::Read(const Vector2d& pixel, Window& window) const
{
  const int radius = window.radius = this->Options.radius;
  const int column = static_cast<int>(std::floor(this->Scale * pixel.x()));
  const int row = static_cast<int>(std::floor(this->Scale * pixel.y()));
  if (column <= radius || row <= radius || column + radius + 1 >= this->Reference.cols ||
    row + radius + 1 >= this->Reference.rows)
  {
    return false;
  }
  window.center = Vector2d(column + 0.5, row + 0.5) / this->Scale;
  const double sigma = Falloff * radius;
  double sum = 0, squares = 0, middleSum = 0, middleSquares = 0;
  int i = 0;
  for (int y = -radius; y <= radius; ++y)
  {
    const float* above = this->Reference[row + y - 1] + column;
    const float* grey = this->Reference[row + y] + column;
    const float* below = this->Reference[row + y + 1] + column;
    for (int x = -radius; x <= radius; ++x, ++i)
    {
      const double value = grey[x];
      const double gx = 0.5 * (grey[x + 1] - grey[x - 1]), gy = 0.5 * (below[x] - above[x]);
      const double misplaced = PlaceDeviation * PlaceDeviation * (gx * gx + gy * gy);
      window.values[i] = grey[x];
      window.weights[i] = static_cast<float>(
        std::exp(-0.5 * (x * x + y * y) / (sigma * sigma)) / (1 + misplaced / (Noise * Noise)));
      sum += value;
      squares += value * value;
      if (std::max(std::abs(x), std::abs(y)) <= MiddleRadius)
      {
        middleSum += value;
        middleSquares += value * value;
      }
    }
  }
  window.contrast = Deviation(sum, squares, i);
  const float mean = static_cast<float>(sum / i);
  std::for_each(window.values.begin(), window.values.begin() + i, [mean](float& v) { v -= mean; });
  constexpr double middle = (2 * MiddleRadius + 1) * (2 * MiddleRadius + 1);
  const double inMiddle = Deviation(middleSum, middleSquares, middle);
  return inMiddle >= this->Options.leastContrast && inMiddle >= MiddleShare * window.contrast;
}

// The partner's grey levels where the plane has the window's pixels, and their slopes against disparity. False where
// one of them lies outside the image.
bool PatchAligner::Warp(const Partner& partner, const Window& window, const PatchPlane& plane,
  Values& values, Values& slopes) const
{
  const int size = 2 * window.radius + 1;
  const double step = 1 / this->Scale;
  const Vector3d alongRow = step * (partner.H.col(0) + plane.slope.x() * partner.epipole);
  const Eigen::Vector3f b = alongRow.cast<float>(), e = partner.epipole.cast<float>();
  const cv::Mat1f& image = partner.grey;
  const float lastColumn = static_cast<float>(image.cols) - 1.5f;
  const float lastRow = static_cast<float>(image.rows) - 1.5f;
  float px[15], py[15], dx[15], dy[15];
  for (int y = 0; y < size; ++y)
  {
    const Vector2d first = window.center + step * Vector2d(-window.radius, y - window.radius);
    const Eigen::Vector3f a =
      (partner.H * first.homogeneous() + plane.At(first) * partner.epipole).cast<float>();
    bool isInside = true;
    for (int x = 0; x < size; ++x)
    {
      const float inverse = 1 / (a.z() + x * b.z());
      px[x] = (a.x() + x * b.x()) * inverse;
      py[x] = (a.y() + x * b.y()) * inverse;
      // A greater disparity moves a point towards the epipole.
      dx[x] = (e.x() - px[x] * e.z()) * inverse;
      dy[x] = (e.y() - py[x] * e.z()) * inverse;
      isInside &= inverse > 0 && px[x] >= 0.5f && py[x] >= 0.5f && px[x] < lastColumn + 1 &&
        py[x] < lastRow + 1;
    }
    if (!isInside)
    {
      return false;
    }
    for (int x = 0; x < size; ++x)
    {
      const float atX = px[x] - 0.5f, atY = py[x] - 0.5f;
      const int left = std::min(static_cast<int>(atX), image.cols - 2);
      const int top = std::min(static_cast<int>(atY), image.rows - 2);
      const float fx = atX - left, fy = atY - top;
      const float* upper = image[top] + left;
      const float* lower = image[top + 1] + left;
      const float upperStep = upper[1] - upper[0], lowerStep = lower[1] - lower[0];
      const float above = upper[0] + fx * upperStep, below = lower[0] + fx * lowerStep;
      values[y * size + x] = above + fy * (below - above);
      slopes[y * size + x] =
        (upperStep + fy * (lowerStep - upperStep)) * dx[x] + (below - above) * dy[x];
    }
  }
  return true;
}

// Adds a partner to the equations, in grey levels of the reference.
void PatchAligner::Add(const Window& window, const PatchPlane& plane, const Values& values,
  const Values& slopes, Equations& equations) const
{
  const int size = 2 * window.radius + 1, count = size * size;
  float sum = 0, squares = 0, product = 0, slopeSum = 0;
  for (int i = 0; i < count; ++i)
  {
    sum += values[i];
    squares += values[i] * values[i];
    product += values[i] * window.values[i];
    slopeSum += slopes[i];
  }
  const double contrast = Deviation(sum, squares, count);
  const double correlation =
    contrast > 0 && window.contrast > 0 ? product / (count * contrast * window.contrast) : 0;
  if (correlation < LeastCorrelation)
  {
    return;
  }
  if (correlation >= this->Options.leastCorrelation)
  {
    ++equations.good;
    equations.correlation += correlation;
  }
  const float gain = static_cast<float>(window.contrast / contrast);
  const float mean = sum / count, slopeMean = slopeSum / count;
  const double step = 1 / this->Scale, du = window.center.x() - plane.pixel.x();
  Matrix3d normal = Matrix3d::Zero();
  Vector3d right = Vector3d::Zero();
  double residuals = 0;
  for (int y = 0; y < size; ++y)
  {
    float s = 0, sx = 0, sxx = 0, r = 0, rx = 0, rr = 0;
    for (int x = 0; x < size; ++x)
    {
      const int i = y * size + x;
      const float slope = gain * (slopes[i] - slopeMean), column = float(x - window.radius);
      const float residual = gain * (values[i] - mean) - window.values[i];
      const float weighted = window.weights[i] * slope;
      s += weighted * slope;
      sx += weighted * slope * column;
      sxx += weighted * slope * column * column;
      r += weighted * residual;
      rx += weighted * residual * column;
      rr += window.weights[i] * residual * residual;
    }
    // From columns about the window's middle to pixels about the plane's.
    const double v = window.center.y() + step * (y - window.radius) - plane.pixel.y();
    const double su = du * s + step * sx;
    const double suu = du * du * s + 2 * du * step * sx + step * step * sxx;
    const double ru = du * r + step * rx;
    Matrix3d row;
    row << s, su, s * v, su, suu, su * v, s * v, su * v, s * v * v;
    normal += row;
    right += Vector3d(r, ru, r * v);
    residuals += rr;
  }
  // What agrees better counts more.
  const double weight = correlation * correlation;
  equations.normal += weight * normal;
  equations.right -= weight * right;
  equations.residuals += weight * residuals;
  equations.weight += weight;
}

double PatchAligner::Parallax(const PatchPlane& plane) const
{
  double most = 0;
  for (const Partner& partner : this->Partners)
  {
    const Vector3d at = partner.H * plane.pixel.homogeneous() + plane.disparity * partner.epipole;
    if (at.z() > 0)
    {
      const Vector2d move =
        (partner.epipole.head<2>() - at.hnormalized() * partner.epipole.z()) / at.z();
      most = std::max(most, move.norm());
    }
  }
  return most / this->Scale;
}

AlignedPatch PatchAligner::Align(const PatchPlane& initial) const
{
  AlignedPatch result;
  PatchPlane& plane = result.plane = initial;
  Window window;
  const double parallax = this->Parallax(initial);
  if (!(parallax > 0) || !this->Read(initial.pixel, window))
  {
    return result;
  }
  const double size = 2 * window.radius + 1;
  const double turn = SlopeDeviation * initial.disparity / this->FocalLength;
  Values values, slopes;
  for (int iteration = 0;; ++iteration)
  {
    Equations equations;
    for (const Partner& partner : this->Partners)
    {
      if (this->Warp(partner, window, plane, values, slopes))
      {
        this->Add(window, plane, values, slopes, equations);
      }
    }
    const double variance = PixelsPerValue *
      std::max(Noise * Noise, equations.residuals / (equations.weight * size * size));
    const Vector3d prior(0, 1 / (turn * turn), 1 / (turn * turn));
    const Vector3d moved(
      0, plane.slope.x() - initial.slope.x(), plane.slope.y() - initial.slope.y());
    Matrix3d normal = equations.normal / variance;
    normal.diagonal() += prior;
    const Matrix3d covariance = normal.inverse();
    const Vector3d change = covariance * (equations.right / variance - prior.cwiseProduct(moved));
    if (!(equations.weight > 0) || !change.allFinite())
    {
      return result;
    }
    const double atRim =
      std::abs(change[0]) + window.radius / this->Scale * change.tail<2>().norm();
    if (iteration == this->Options.iterations || atRim * parallax < Still)
    {
      result.deviation = std::sqrt(std::max(0.0, covariance(0, 0)));
      result.correlation = equations.good > 0 ? equations.correlation / equations.good : 0;
      result.isGood = equations.good >= this->Options.leastPartners &&
        result.deviation * parallax < this->Options.mostDeviation;
      return result;
    }
    plane.disparity += change[0];
    plane.slope += change.tail<2>();
    if (!(plane.disparity > 0) ||
      std::abs(plane.disparity - initial.disparity) * parallax > this->Options.mostShift)
    {
      return result;
    }
  }
}

}
