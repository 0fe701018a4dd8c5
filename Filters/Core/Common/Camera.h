// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Camera_h
#define freespace_Camera_h

#include <Eigen/Dense>

#include <cmath>

namespace freespace
{

/// A calibrated pinhole camera without distortion.
///
/// It looks along +z with x to the right and y down: `x_cam = R * x_world + t`. Pixels follow COLMAP:
/// the centre of the first pixel is (0.5, 0.5). Lengths are in the unit of the camera model.
struct Camera
{
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity(); ///< intrinsics, pixels
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity(); ///< rotation of cam_from_world
  Eigen::Vector3d t = Eigen::Vector3d::Zero();     ///< translation of cam_from_world
  int width = 0;                                   ///< of the image, pixels
  int height = 0;

  /// The centre of projection in the world.
  Eigen::Vector3d Center() const { return -R.transpose() * t; }

  /// The point in the camera's frame; its z is the depth.
  Eigen::Vector3d FromWorld(const Eigen::Vector3d& world) const { return R * world + t; }

  /// Depth along the optical axis; negative behind the camera.
  double Depth(const Eigen::Vector3d& world) const { return R.row(2).dot(world) + t.z(); }

  /// Pixel of a point. Meaningful only where Depth is positive.
  Eigen::Vector2d Project(const Eigen::Vector3d& world) const
  {
    return (K * FromWorld(world)).hnormalized();
  }

  /// World direction of the ray through a pixel, scaled so that a step of 1 is a depth of 1.
  Eigen::Vector3d Ray(const Eigen::Vector2d& pixel) const
  {
    return R.transpose() * (K.inverse() * pixel.homogeneous());
  }

  /// The world point seen at a pixel with the given depth.
  Eigen::Vector3d Unproject(const Eigen::Vector2d& pixel, double depth) const
  {
    return Center() + depth * Ray(pixel);
  }

  /// Pixels per unit of x/z and y/z: the geometric mean of both.
  double FocalLength() const { return std::sqrt(std::abs(K(0, 0) * K(1, 1))); }

  /// Whether a pixel lies on the image.
  bool Sees(const Eigen::Vector2d& pixel) const
  {
    return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= width && pixel.y() <= height;
  }
};

}

#endif
