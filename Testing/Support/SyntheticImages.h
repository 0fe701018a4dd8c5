// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SyntheticImages_h
#define freespace_SyntheticImages_h

#include "Common/Camera.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace freespace
{

/// A plane z = depth + slope . (x, y) that has a colour (blue, green, red; 0 .. 255) where it is.
struct Layer
{
  double depth = 1;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  std::function<bool(double x, double y)> exists;
  std::function<Eigen::Vector3d(double x, double y)> color;

  /// Where a ray meets the plane, as a multiple of the direction; negative when it does not.
  double Meet(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const
  {
    const double rate = direction.z() - this->slope.dot(direction.head<2>());
    const double t = (this->depth + this->slope.dot(origin.head<2>()) - origin.z()) / rate;
    return std::isfinite(t) ? t : -1;
  }
};

using Layers = std::vector<Layer>;

inline std::function<bool(double, double)> Everywhere()
{
  return [](double, double) { return true; };
}

inline std::function<Eigen::Vector3d(double, double)> Plain(double b, double g, double r)
{
  return [=](double, double) { return Eigen::Vector3d(b, g, r); };
}

/// Squares of the given side with random colours.
inline std::function<Eigen::Vector3d(double, double)> RandomSquares(double side, std::uint32_t seed)
{
  return [=](double x, double y)
  {
    std::uint32_t hash = seed;
    for (const double at : { std::floor(x / side), std::floor(y / side) })
    {
      hash = (hash ^ static_cast<std::uint32_t>(static_cast<std::int32_t>(at))) * 2654435761u;
      hash ^= hash >> 15;
    }
    hash *= 2246822519u;
    return Eigen::Vector3d(
      30 + (hash >> 24) * 0.75, 30 + (hash >> 16 & 255) * 0.75, 30 + (hash >> 8 & 255) * 0.75);
  };
}

/// Two planes of coloured squares: one behind everything, and a slanted one before it where it exists.
inline Layers TwoPlanes(double backDepth, std::function<bool(double, double)> frontExists)
{
  Layer back, front;
  back.depth = backDepth;
  back.exists = Everywhere();
  back.color = RandomSquares(0.05, 5);
  front.depth = 0.9;
  front.slope = { 0.3, 0.1 };
  front.exists = std::move(frontExists);
  front.color = RandomSquares(0.04, 9);
  return { back, front };
}

/// What a ray sees; black where there is nothing. Returns the distance through `t` when asked.
inline Eigen::Vector3d Trace(const Layers& layers, const Eigen::Vector3d& origin,
  const Eigen::Vector3d& direction, double* t = nullptr)
{
  double nearest = std::numeric_limits<double>::infinity();
  Eigen::Vector3d color = Eigen::Vector3d::Zero();
  for (const Layer& layer : layers)
  {
    const double at = layer.Meet(origin, direction);
    const Eigen::Vector3d p = origin + at * direction;
    if (at > 0 && at < nearest && layer.exists(p.x(), p.y()))
    {
      nearest = at;
      color = layer.color(p.x(), p.y());
    }
  }
  if (t)
  {
    *t = nearest;
  }
  return color;
}

/// Maps a pixel of the image to the pixel at which a camera without distortion sees the same.
using PixelMap = std::function<Eigen::Vector2d(const Eigen::Vector2d&)>;

/// The image that a camera takes, each pixel the mean of some rays spread evenly over its area (a
/// Fibonacci lattice, which favours no direction of an edge).
inline cv::Mat Render(
  const Layers& layers, const Camera& camera, const PixelMap& undistort = nullptr, int rays = 40)
{
  constexpr double golden = 0.6180339887498949;
  cv::Mat image(camera.height, camera.width, CV_8UC3);
  const Eigen::Vector3d origin = camera.Center();
  for (int y = 0; y < image.rows; ++y)
  {
    for (int x = 0; x < image.cols; ++x)
    {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (int i = 0; i < rays; ++i)
      {
        const Eigen::Vector2d pixel(x + (i + 0.5) / rays, y + std::fmod((i + 0.5) * golden, 1.0));
        sum += Trace(layers, origin, camera.Ray(undistort ? undistort(pixel) : pixel));
      }
      for (int c = 0; c < 3; ++c)
      {
        image.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<std::uint8_t>(sum[c] / rays);
      }
    }
  }
  return image;
}

/// A camera at (x, 0, 0) that looks along +z. The axes of all of them are parallel, so that a point at
/// depth z moves by focalLength * baseline / z pixels along its row from one to another.
inline Camera ParallelCamera(double x, int width = 640, int height = 480, double focalLength = 500)
{
  Camera camera;
  camera.K << focalLength, 0, width / 2.0, 0, focalLength, height / 2.0, 0, 0, 1;
  camera.width = width;
  camera.height = height;
  camera.t = Eigen::Vector3d(-x, 0, 0);
  return camera;
}

/// A camera at a place, turned to look at a target, with y down.
inline Camera LookAt(const Eigen::Vector3d& center, const Eigen::Vector3d& target)
{
  Camera camera;
  camera.width = 240;
  camera.height = 180;
  camera.K << 400, 0, 121.3, 0, 400, 88.6, 0, 0, 1;
  const Eigen::Vector3d z = (target - center).normalized();
  const Eigen::Vector3d x = Eigen::Vector3d(0, 1, 0).cross(z).normalized();
  camera.R.row(0) = x;
  camera.R.row(1) = z.cross(x);
  camera.R.row(2) = z;
  camera.t = -camera.R * center;
  return camera;
}

/// A cross of five: the reference, left, right, up and down. The centres are not collinear and the
/// axes converge.
inline std::vector<Camera> CrossOfCameras()
{
  const Eigen::Vector3d target(0, 0, 1);
  return { LookAt({ 0, 0, 0 }, target), LookAt({ -0.1, 0.004, -0.006 }, target),
    LookAt({ 0.1, 0.006, 0.004 }, target), LookAt({ 0.005, -0.1, -0.003 }, target),
    LookAt({ -0.003, 0.1, 0.005 }, target) };
}

}

#endif
