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

// Lower bound of the error of a position, in pixels, since sampling and cameras are not exact. It makes
// steep grey levels less certain.
constexpr double PlaceDeviation = 0.1;

// Images are smoothed and interpolated, and a surface is not quite a plane, so that a window has fewer
// independent values than pixels: with so many, the errors on scenes with truth are as large as the deviations.
constexpr double PixelsPerValue = 13;

// Of the Gaussian with which pixels count less towards the rim of a window, as a fraction of its radius.
constexpr double Falloff = 0.72;

// Standard deviation of the tangent of a plane's turn: how well its slope is known beforehand.
constexpr double SlopeDeviation = 0.7;

// A partner that correlates less with the reference shows something else.
constexpr double LeastCorrelation = 0.3;

// Convergence: the largest motion of the window in a partner, in pixels, is below this.
constexpr double Still = 0.03;

// The centre of a window, which must have contrast: otherwise an edge at the rim would determine a feature
// in a part without texture.
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
  Vector2d center;     // of the middle pixel, in pixels of the camera
  Values values{};     // zero mean
  Values weights{};    // of squared residuals
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
  , Pixels(options.radius)
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
  const int radius = this->Options.radius;
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
  const double step = 1 / this->Scale;
  const Vector3d origin =
    partner.H * window.center.homogeneous() + plane.At(window.center) * partner.epipole;
  const Vector3d alongColumn = step * (partner.H.col(0) + plane.slope.x() * partner.epipole);
  const Vector3d alongRow = step * (partner.H.col(1) + plane.slope.y() * partner.epipole);
  PlaneWarp warp;
  for (int i = 0; i < 3; ++i)
  {
    warp.origin[i] = static_cast<float>(origin[i]);
    warp.alongColumn[i] = static_cast<float>(alongColumn[i]);
    warp.alongRow[i] = static_cast<float>(alongRow[i]);
    warp.perDisparity[i] = static_cast<float>(partner.epipole[i]);
  }
  return WarpWindow(this->Pixels, warp, partner.grey, values, slopes);
}

// Adds a partner to the equations, in grey levels of the reference.
void PatchAligner::Add(const Window& window, const PatchPlane& plane, const Values& values,
  const Values& slopes, Equations& equations) const
{
  const int count = this->Pixels.count;
  const WindowMoments moments = MomentsOf(this->Pixels, values, slopes, window.values);
  const double contrast = Deviation(moments.value, moments.square, count);
  const double correlation = contrast > 0 && window.contrast > 0
    ? moments.product / (count * contrast * window.contrast)
    : 0;
  if (correlation < LeastCorrelation)
  {
    return;
  }
  if (correlation >= this->Options.leastCorrelation)
  {
    ++equations.good;
    equations.correlation += correlation;
  }
  const WindowSums sums = SumWindow(this->Pixels, values, slopes, window.values, window.weights,
    static_cast<float>(window.contrast / contrast), moments.value / count, moments.slope / count);
  // From columns and rows about the window's middle to pixels about the plane's.
  const double step = 1 / this->Scale;
  const double u = window.center.x() - plane.pixel.x(), v = window.center.y() - plane.pixel.y();
  const double su = u * sums.s + step * sums.sc, sv = v * sums.s + step * sums.sr;
  const double suu = u * u * sums.s + 2 * u * step * sums.sc + step * step * sums.scc;
  const double svv = v * v * sums.s + 2 * v * step * sums.sr + step * step * sums.srr;
  const double suv = u * v * sums.s + step * (u * sums.sr + v * sums.sc) + step * step * sums.scr;
  Matrix3d normal;
  normal << sums.s, su, sv, su, suu, suv, sv, suv, svv;
  const Vector3d right(sums.r, u * sums.r + step * sums.rc, v * sums.r + step * sums.rr);
  // Partners that agree better have more weight.
  const double weight = correlation * correlation;
  equations.normal += weight * normal;
  equations.right -= weight * right;
  equations.residuals += weight * sums.residuals;
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
  result.isTextured = this->Read(initial.pixel, window);
  if (!(parallax > 0) || !result.isTextured)
  {
    return result;
  }
  const double size = 2 * this->Options.radius + 1;
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
      std::abs(change[0]) + this->Options.radius / this->Scale * change.tail<2>().norm();
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
