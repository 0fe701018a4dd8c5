// SPDX-License-Identifier: BSD-3-Clause
#include "Epipolar/EpipolarPair.h"

#include "Common/Error.h"

namespace freespace
{

EpipolarPair::EpipolarPair(const Camera& reference, const Camera& other)
{
  const Eigen::Vector3d line = other.Center() - reference.Center();
  if (!(line.norm() > 0))
  {
    throw Error("Two images of a triplet are taken from the same place.");
  }
  // The mean viewing direction of both cameras, perpendicular to the baseline.
  const Eigen::Vector3d forward = (reference.R.row(2) + other.R.row(2)).transpose();
  const Eigen::Vector3d x = line.normalized();
  Eigen::Vector3d z = forward - forward.dot(x) * x;
  if (!(z.norm() > 1e-6))
  {
    z = x.unitOrthogonal(); // one camera straight before the other: rays are left with scale <= 0
  }
  z.normalize();
  Eigen::Matrix3d rectifiedFromWorld;
  rectifiedFromWorld.row(0) = x;
  rectifiedFromWorld.row(1) = z.cross(x);
  rectifiedFromWorld.row(2) = z;

  const double focal = reference.K(0, 0);
  const Eigen::DiagonalMatrix<double, 3> scale(focal, focal, 1.0);
  this->Reference = scale * rectifiedFromWorld * reference.R.transpose() * reference.K.inverse();
  this->Other = scale * rectifiedFromWorld * other.R.transpose() * other.K.inverse();
  this->Baseline = line.norm() * focal;
}

}
