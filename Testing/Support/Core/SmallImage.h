// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SmallImage_h
#define freespace_SmallImage_h

#include "Common/Camera.h"
#include "Mesh/TriangleMesh.h"

#include <Eigen/Geometry>

namespace freespace
{

/// A camera of 40 x 30 pixels, turned.
inline Camera SmallCamera()
{
  Camera camera;
  camera.width = 40;
  camera.height = 30;
  camera.K << 35, 0, 19, 0, 36, 16, 0, 0, 1;
  camera.R = Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, -2, 0.5).normalized()).matrix();
  camera.t = { 0.1, -0.2, 0.3 };
  return camera;
}

inline void AddTriangle(
  TriangleMesh& mesh, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  const int first = static_cast<int>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), { a, b, c });
  mesh.triangles.push_back({ first, first + 1, first + 2 });
}

/// A square parallel to the image, given by pixels.
inline void AddSquare(
  TriangleMesh& mesh, const Camera& camera, double left, double right, double depth)
{
  const auto at = [&](double u, double v) { return camera.Unproject({ u, v }, depth); };
  AddTriangle(mesh, at(left, -500), at(right, -500), at(right, 500));
  AddTriangle(mesh, at(left, -500), at(right, 500), at(left, 500));
}

}

#endif
