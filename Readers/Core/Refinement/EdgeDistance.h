// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_EdgeDistance_h
#define freespace_EdgeDistance_h

#include "Common/Camera.h"
#include "Refinement/EdgeTracks.h"

#include <ceres/sized_cost_function.h>

#include <array>

namespace freespace
{

/// The motion of a camera from its given pose: a rotation about its own centre (angle-axis, radians) and
/// a translation in its own frame, in depths of the scene, so that all parameters have a similar scale.
using CameraMotion = std::array<double, 6>;

/// A camera that moves during an adjustment. What all its observations need is computed once for each motion.
class MovingCamera
{
public:
  /// `depth` is the scene's before the camera, world units.
  MovingCamera(const Camera& given, double depth);

  /// The focal lengths become those given times exp(logFocal).
  void Move(const CameraMotion& motion, double logFocal);

  /// The camera where it has moved.
  const Camera& Current() const { return this->Now; }

  /// The pixel of a point in its frame.
  Eigen::Vector2d Pixel(const Eigen::Vector3d& inCamera) const
  {
    return this->Now.K.topLeftCorner<2, 2>() * inCamera.head<2>() / inCamera.z() +
      this->Now.K.topRightCorner<2, 1>();
  }

  /// The derivatives of that pixel.
  struct Derivatives
  {
    Eigen::Matrix<double, 2, 6> motion;
    Eigen::Vector2d logFocal;
    Eigen::Matrix<double, 2, 3> world;
  };
  Derivatives PixelDerivatives(const Eigen::Vector3d& inCamera) const;

private:
  Camera Given, Now;
  double Depth;
  Eigen::Vector3d Step;             // the part of the translation that the motion's makes
  Eigen::Matrix3d RotationJacobian; // of the rotation vector: left Jacobian of SO(3)
};

/// The distance of a point's projection from its edge, in deviations. Along the edge it is constrained by the
/// reference only. Parameters: the camera's motion, the logarithm of its focal length's change and the point; the
/// camera has to be moved by the first two beforehand.
class EdgeDistance : public ceres::SizedCostFunction<2, 6, 1, 3>
{
public:
  /// The weights are the inverse deviations across and along the edge, per pixel. Keeps references.
  EdgeDistance(const MovingCamera& camera, const EdgeObservation& observation, double weight,
    double weightAlong);

  /// False where the point is not in front of the camera.
  bool Evaluate(
    double const* const* parameters, double* residuals, double** jacobians) const override;

private:
  const MovingCamera& Moving;
  const EdgeObservation& Observation;
  Eigen::Matrix2d ToDeviations; // from pixels: across the edge, along it
};

}

#endif
