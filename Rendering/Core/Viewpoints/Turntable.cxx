// SPDX-License-Identifier: BSD-3-Clause
#include "Viewpoints/Turntable.h"

#include "Common/Error.h"
#include "Viewpoints/CommonUp.h"
#include "Viewpoints/FramePoints.h"
#include "Viewpoints/LookAt.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

namespace
{

Eigen::Vector3d PointNearestToAxes(const std::vector<Camera>& cameras)
{
  Eigen::Matrix3d system = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Camera& camera : cameras)
  {
    const Eigen::Vector3d axis = camera.R.row(2);
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - axis * axis.transpose();
    system += across;
    right += across * camera.Center();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> values(system);
  if (!(values.eigenvalues()[0] > 1e-4 * cameras.size()))
  {
    throw Error("The cameras all look the same way: there is no middle for a turntable.");
  }
  return system.ldlt().solve(right);
}

}

std::vector<Camera> TurntableCameras(
  const std::vector<Camera>& cameras, int count, const std::vector<Eigen::Vector3d>& points)
{
  if (cameras.empty())
  {
    throw Error("A turntable needs a camera to begin with.");
  }
  const Eigen::Vector3d middle = PointNearestToAxes(cameras);
  const Eigen::Vector3d up = CommonUp(cameras);
  double height = 0;
  double radius = 0;
  for (const Camera& camera : cameras)
  {
    const Eigen::Vector3d from = camera.Center() - middle;
    height += from.dot(up) / cameras.size();
    radius += (from - from.dot(up) * up).norm() / cameras.size();
  }
  const Eigen::Vector3d first = cameras[0].Center() - middle;
  const Eigen::Vector3d start = (first - first.dot(up) * up).normalized();
  const Eigen::Vector3d side = up.cross(start);
  std::vector<Camera> path;
  double farther = 0;
  for (int i = 0; i < count; ++i)
  {
    const double angle = 2 * M_PI * i / count;
    const Eigen::Vector3d around = std::cos(angle) * start + std::sin(angle) * side;
    path.push_back(LookAt(cameras[0], middle + radius * around + height * up, middle, up));
    farther = std::max(farther, FarEnough(path.back(), middle, points));
  }
  for (Camera& camera : path)
  {
    camera = LookAt(camera, middle + farther * (camera.Center() - middle), middle, up);
  }
  return path;
}

}
