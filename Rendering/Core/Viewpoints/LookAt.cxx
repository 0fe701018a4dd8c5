// SPDX-License-Identifier: BSD-3-Clause
#include "Viewpoints/LookAt.h"

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

}
