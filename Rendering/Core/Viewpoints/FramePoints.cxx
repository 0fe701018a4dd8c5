// SPDX-License-Identifier: BSD-3-Clause
#include "Viewpoints/FramePoints.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

namespace
{

constexpr double margin = 1.0 / 52; // of the picture's width and height

double Quantile(std::vector<double>& values, double share)
{
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * (values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// The greatest value. Where outliers may be cut off, at most that which lies above the middle nine tenths of the values
// by half of their range.
double Reach(std::vector<double>& values, Outliers outliers)
{
  const double most = *std::max_element(values.begin(), values.end());
  if (outliers == Outliers::InFrame)
  {
    return most;
  }
  const double high = Quantile(values, 0.95);
  return std::min(most, high + 0.5 * (high - Quantile(values, 0.05)));
}

/// The two sides of a picture that bound one coordinate, x or y over z. A point (x, z) is held by a camera at
/// (a, c) where low (z - c) <= x - a <= high (z - c): two half-planes, whose extremes over all points
/// are enough.
struct Sides
{
  double low = 0;
  double high = 0;
  double reachLow = 0;
  double reachHigh = 0;

  Sides(double focal, double middle, double size)
    : low((margin * size - middle) / focal)
    , high(((1 - margin) * size - middle) / focal)
  {
  }

  void Hold(const std::vector<Eigen::Vector3d>& points, int axis, Outliers outliers)
  {
    std::vector<double> above;
    std::vector<double> below;
    for (const Eigen::Vector3d& point : points)
    {
      above.push_back(point[axis] - this->high * point.z());
      below.push_back(this->low * point.z() - point[axis]);
    }
    this->reachHigh = Reach(above, outliers);
    this->reachLow = Reach(below, outliers);
  }

  // The farthest place along z, and the middle of the places across for one.
  double Nearest() const { return -(this->reachHigh + this->reachLow) / (this->high - this->low); }
  double Across(double z) const
  {
    return (this->reachHigh + this->high * z - this->reachLow + this->low * z) / 2;
  }
};

}

Camera FramePoints(
  const Camera& camera, const std::vector<Eigen::Vector3d>& points, Outliers outliers)
{
  std::vector<Eigen::Vector3d> seen;
  for (const Eigen::Vector3d& point : points)
  {
    if (point.allFinite())
    {
      seen.push_back(camera.FromWorld(point));
    }
  }
  if (seen.empty())
  {
    return camera;
  }
  Sides x(camera.K(0, 0), camera.K(0, 2), camera.width);
  Sides y(camera.K(1, 1), camera.K(1, 2), camera.height);
  x.Hold(seen, 0, outliers);
  y.Hold(seen, 1, outliers);
  const double z = std::min(x.Nearest(), y.Nearest());
  Camera moved = camera;
  moved.t -= Eigen::Vector3d(x.Across(z), y.Across(z), z);
  return moved;
}

double FarEnough(
  const Camera& camera, const Eigen::Vector3d& middle, const std::vector<Eigen::Vector3d>& points)
{
  const Sides x(camera.K(0, 0), camera.K(0, 2), camera.width);
  const Sides y(camera.K(1, 1), camera.K(1, 2), camera.height);
  std::vector<double> depths;
  for (const Eigen::Vector3d& point : points)
  {
    if (point.allFinite())
    {
      const Eigen::Vector3d from = camera.R * (point - middle);
      const double across = std::max(
        from.x() / (from.x() < 0 ? x.low : x.high), from.y() / (from.y() < 0 ? y.low : y.high));
      depths.push_back(across - from.z());
    }
  }
  return depths.empty() ? 1 : Reach(depths, Outliers::MayBeCutOff) / camera.Depth(middle);
}

Camera WithSize(const Camera& camera, int width, int height)
{
  const double scale = std::min(double(width) / camera.width, double(height) / camera.height);
  const Eigen::Vector2d middle(camera.width / 2.0, camera.height / 2.0);
  Camera sized = camera;
  sized.width = width;
  sized.height = height;
  sized.K.topRows<2>() *= scale;
  sized.K.col(2).head<2>() += Eigen::Vector2d(width / 2.0, height / 2.0) - scale * middle;
  return sized;
}

}
