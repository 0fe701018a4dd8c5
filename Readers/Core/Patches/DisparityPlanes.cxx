// SPDX-License-Identifier: BSD-3-Clause
#include "Patches/DisparityPlanes.h"

#include "Disparity/DelaunayDisparity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace freespace
{

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

// The tangent of the steepest incidence on a surface: 75 degrees.
constexpr double SteepestTangent = 3.7;

// Of the features' disparities, a fraction of them: what noise may make of it.
constexpr double FeatureNoise = 2e-3;

constexpr int WindowRadius = 6; // pixels
constexpr int WindowStep = 2;

// Of a window, the least part that must have a disparity.
constexpr double LeastPart = 0.9;

// The columns whose pixels' centres in a row lie in a triangle of the given orientation, from the first one to the one
// after the last.
std::pair<int, int> ColumnsInside(
  const Vector2d (&corners)[3], double area, int row, const std::pair<int, int>& within)
{
  double first = within.first + 0.5, last = within.second - 0.5;
  for (int k = 0; k < 3; ++k)
  {
    const Vector2d side = corners[(k + 1) % 3] - corners[k];
    const double down = row + 0.5 - corners[k].y();
    // Inside is where side.x * down - side.y * (x - corner.x) has the sign of the area.
    const double slope = side.y() * area, level = side.x() * down * area;
    if (slope < 0)
    {
      first = std::max(first, corners[k].x() + level / slope);
    }
    else if (slope > 0)
    {
      last = std::min(last, corners[k].x() + level / slope);
    }
    else if (level < 0)
    {
      return { 0, 0 };
    }
  }
  return { static_cast<int>(std::ceil(first - 0.5)), static_cast<int>(std::floor(last - 0.5)) + 1 };
}

}

DisparityPlanes::DisparityPlanes(const View& view)
  : Disparity(view.camera.height, view.camera.width, 0.0f)
  , Steepest(SteepestTangent / view.camera.K(0, 0))
{
  DelaunayDisparityOptions options;
  options.minimumDisparity = false;
  const DisparityMap map = TriangulateView({ view }, 0, options);
  for (const auto& triangle : map.triangles)
  {
    this->Paint(map, triangle);
  }
}

void DisparityPlanes::Paint(const View& view, const std::array<int, 3>& corners)
{
  Vector2d at[3];
  Vector3d disparity;
  for (int k = 0; k < 3; ++k)
  {
    at[k] = view.imagePoints[corners[k]];
    disparity[k] = 1 / view.camera.Depth(view.points[corners[k]]);
  }
  Eigen::Matrix2d sides;
  sides << (at[1] - at[0]).transpose(), (at[2] - at[0]).transpose();
  const double area = sides.determinant();
  if (std::abs(area) < 1e-9)
  {
    return;
  }
  const Vector2d slope =
    sides.inverse() * Vector2d(disparity[1] - disparity[0], disparity[2] - disparity[0]);
  // In small triangles noise alone makes slopes.
  if (disparity.maxCoeff() - disparity.minCoeff() > FeatureNoise * disparity[0] &&
    slope.norm() > this->Steepest * disparity[0])
  {
    return;
  }
  const auto [left, right] = std::minmax({ at[0].x(), at[1].x(), at[2].x() });
  const auto [top, bottom] = std::minmax({ at[0].y(), at[1].y(), at[2].y() });
  const auto first = [](double from)
  { return std::max(0, static_cast<int>(std::ceil(from - 0.5))); };
  const auto last = [](double to, int size)
  { return std::min(size - 1, static_cast<int>(std::floor(to - 0.5))); };
  const std::pair<int, int> within(first(left), last(right, this->Disparity.cols) + 1);
  for (int row = first(top); row <= last(bottom, this->Disparity.rows); ++row)
  {
    const auto [begin, end] = ColumnsInside(at, area, row, within);
    for (int column = begin; column < end; ++column)
    {
      const Vector2d pixel(column + 0.5, row + 0.5);
      this->Disparity(row, column) = static_cast<float>(disparity[0] + slope.dot(pixel - at[0]));
    }
  }
}

bool DisparityPlanes::Fit(const Vector2d& pixel, PatchPlane& plane, double& roughness) const
{
  const int column = static_cast<int>(std::floor(pixel.x()));
  const int row = static_cast<int>(std::floor(pixel.y()));
  Matrix3d normal = Matrix3d::Zero();
  Vector3d right = Vector3d::Zero();
  double squares = 0;
  int count = 0, all = 0;
  float least = std::numeric_limits<float>::infinity(), most = 0;
  for (int y = row - WindowRadius; y <= row + WindowRadius; y += WindowStep)
  {
    for (int x = column - WindowRadius; x <= column + WindowRadius; x += WindowStep, ++all)
    {
      const bool isOutside =
        y < 0 || x < 0 || y >= this->Disparity.rows || x >= this->Disparity.cols;
      const float disparity = isOutside ? 0.0f : this->Disparity(y, x);
      if (disparity > 0)
      {
        const Vector3d offset(1, x + 0.5 - pixel.x(), y + 0.5 - pixel.y());
        normal += offset * offset.transpose();
        right += disparity * offset;
        squares += double(disparity) * disparity;
        least = std::min(least, disparity);
        most = std::max(most, disparity);
        ++count;
      }
    }
  }
  if (count < LeastPart * all || most - least > 2 * WindowRadius * this->Steepest * most)
  {
    return false;
  }
  const Vector3d fitted = normal.ldlt().solve(right);
  plane.pixel = pixel;
  plane.disparity = fitted[0];
  plane.slope = fitted.tail<2>();
  roughness = std::sqrt(std::max(0.0, (squares - fitted.dot(right)) / count));
  return fitted.allFinite() && fitted[0] > 0;
}

}
