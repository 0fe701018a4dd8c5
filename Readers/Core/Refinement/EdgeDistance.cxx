// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/EdgeDistance.h"

#include <Eigen/Geometry>

#include <cmath>

namespace freespace
{

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

Matrix3d CrossProductMatrix(const Vector3d& v)
{
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// J with exp(w + d) = exp(J d) exp(w) to first order, exp(w) the rotation by w (Chirikjian, Stochastic Models,
// Information Theory, and Lie Groups 2, section 10.7).
Matrix3d LeftJacobian(const Vector3d& w)
{
  const Matrix3d cross = CrossProductMatrix(w);
  const double squared = w.squaredNorm(), angle = std::sqrt(squared);
  // Below, the series; its next terms are smaller than the rounding.
  const bool isSmall = angle < 1e-4;
  const double a = isSmall ? 0.5 - squared / 24 : (1 - std::cos(angle)) / squared;
  const double b =
    isSmall ? 1.0 / 6 - squared / 120 : (angle - std::sin(angle)) / (squared * angle);
  return Matrix3d::Identity() + a * cross + b * cross * cross;
}

}

MovingCamera::MovingCamera(const Camera& given, double depth)
  : Given(given)
  , Now(given)
  , Depth(depth)
{
  this->Move(CameraMotion{}, 0);
}

void MovingCamera::Move(const CameraMotion& motion, double logFocal)
{
  const Vector3d turn(motion[0], motion[1], motion[2]);
  const double angle = turn.norm();
  const Matrix3d R = angle > 0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix()
                               : Matrix3d(Matrix3d::Identity());
  this->Now.R = R * this->Given.R;
  this->Step = this->Depth * Vector3d(motion[3], motion[4], motion[5]);
  this->Now.t = R * this->Given.t + this->Step;
  this->RotationJacobian = LeftJacobian(turn);
  this->Now.K.topLeftCorner<2, 2>() = std::exp(logFocal) * this->Given.K.topLeftCorner<2, 2>();
}

MovingCamera::Derivatives MovingCamera::PixelDerivatives(const Vector3d& inCamera) const
{
  const Eigen::Matrix2d K = this->Now.K.topLeftCorner<2, 2>();
  const Vector2d image = inCamera.head<2>() / inCamera.z();
  Eigen::Matrix<double, 2, 3> projection; // of the pixel by the point in the camera's frame
  projection << K, -K * image;
  projection /= inCamera.z();
  Derivatives result;
  result.motion.leftCols<3>() =
    -projection * CrossProductMatrix(inCamera - this->Step) * this->RotationJacobian;
  result.motion.rightCols<3>() = this->Depth * projection;
  result.logFocal = K * image;
  result.world = projection * this->Now.R;
  return result;
}

EdgeDistance::EdgeDistance(
  const MovingCamera& camera, const EdgeObservation& observation, double weight, double weightAlong)
  : Moving(camera)
  , Observation(observation)
{
  const Vector2d& normal = observation.normal;
  this->ToDeviations << weight * normal.x(), weight * normal.y(), -weightAlong * normal.y(),
    weightAlong * normal.x();
}

bool EdgeDistance::Evaluate(
  double const* const* parameters, double* residuals, double** jacobians) const
{
  const Vector3d inCamera =
    this->Moving.Current().FromWorld(Eigen::Map<const Vector3d>(parameters[2]));
  if (!(inCamera.z() > 0))
  {
    return false;
  }
  const Vector2d off = this->Moving.Pixel(inCamera) - this->Observation.position;
  Eigen::Map<Vector2d>{ residuals } = this->ToDeviations * off;
  if (!jacobians)
  {
    return true;
  }
  const MovingCamera::Derivatives pixel = this->Moving.PixelDerivatives(inCamera);
  if (jacobians[0])
  {
    Eigen::Map<Eigen::Matrix<double, 2, 6, Eigen::RowMajor>>{ jacobians[0] } =
      this->ToDeviations * pixel.motion;
  }
  if (jacobians[1])
  {
    Eigen::Map<Vector2d>{ jacobians[1] } = this->ToDeviations * pixel.logFocal;
  }
  if (jacobians[2])
  {
    Eigen::Map<Eigen::Matrix<double, 2, 3, Eigen::RowMajor>>{ jacobians[2] } =
      this->ToDeviations * pixel.world;
  }
  return true;
}

}
