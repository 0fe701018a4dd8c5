// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_EpipolarPair_h
#define freespace_EpipolarPair_h

#include "Common/Camera.h"

namespace freespace
{

/// Rectifies two cameras: both are turned to one orientation whose x axis lies along the
/// line from the reference's centre to the other's. A point then has the same row v in both and its
/// columns differ by baseline / depth. Edge positions are rectified, never images, so that nothing
/// is resampled, and each pair has its own exact geometry: the three centres of a triplet need not
/// be collinear.
class EpipolarPair
{
public:
  /// Throws Error when both centres coincide.
  EpipolarPair(const Camera& reference, const Camera& other);

  /// A rectified pixel (u, v), in units of the reference's focal length, and the depth in the
  /// rectified frame of the point that lies at depth 1 in the camera's own.
  struct Ray
  {
    double u, v;
    double scale; ///< not positive: not in front of the rectified camera
  };
  Ray FromReference(const Eigen::Vector2d& pixel) const { return Apply(this->Reference, pixel); }
  Ray FromOther(const Eigen::Vector2d& pixel) const { return Apply(this->Other, pixel); }

  /// From pixels to rectified rays.
  const Eigen::Matrix3d& ReferenceHomography() const { return this->Reference; }
  const Eigen::Matrix3d& OtherHomography() const { return this->Other; }

  /// How the rectified pixel moves with the pixel whose ray this is: d(u, v) / d(x, y).
  Eigen::Matrix2d ReferenceJacobian(const Ray& ray) const { return Jacobian(this->Reference, ray); }
  Eigen::Matrix2d OtherJacobian(const Ray& ray) const { return Jacobian(this->Other, ray); }

  /// Disparity (1 / depth in the reference camera) of a point seen on this ray and in column u of
  /// the other image.
  double Disparity(const Ray& ray, double u) const
  {
    return (ray.u - u) * ray.scale / this->Baseline;
  }

  /// Column of the other image in which a point with this disparity is seen.
  double Column(const Ray& ray, double disparity) const
  {
    return ray.u - disparity * this->Baseline / ray.scale;
  }

  /// Distance between the centres times the focal length: rectified pixels per unit of disparity.
  double Baseline;

private:
  static Ray Apply(const Eigen::Matrix3d& homography, const Eigen::Vector2d& pixel)
  {
    const Eigen::Vector3d ray = homography * pixel.homogeneous();
    const double inverse = 1 / ray.z();
    return { ray.x() * inverse, ray.y() * inverse, ray.z() };
  }
  static Eigen::Matrix2d Jacobian(const Eigen::Matrix3d& homography, const Ray& ray)
  {
    return (homography.topLeftCorner<2, 2>() -
             Eigen::Vector2d(ray.u, ray.v) * homography.block<1, 2>(2, 0)) /
      ray.scale;
  }

  Eigen::Matrix3d Reference; // homographies from pixels to rectified rays
  Eigen::Matrix3d Other;
};

}

#endif
