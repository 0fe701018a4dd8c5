// SPDX-License-Identifier: BSD-3-Clause
#include "LookAt.h"

namespace freespace
{

Camera LookAt(const Camera& like, const Eigen::Vector3d& center, const Eigen::Vector3d& middle,
  const Eigen::Vector3d& up)
{
  Camera camera = like;
  const Eigen::Vector3d forward = (middle - center).normalized();
  const Eigen::Vector3d right = forward.cross(up).normalized();
  camera.R << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  camera.t = -camera.R * center;
  return camera;
}

Eigen::Vector3d MeanUp(const std::vector<Camera>& cameras)
{
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  for (const Camera& camera : cameras)
  {
    up -= camera.R.row(1).transpose() / cameras.size();
  }
  return up.norm() > 0.05 ? up.normalized() : Eigen::Vector3d::Zero();
}

}
