// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SurfaceGeometry_h
#define freespace_SurfaceGeometry_h

#include "Mesh/TriangleMesh.h"

#include <array>
#include <vector>

namespace freespace
{

/// The normals, areas and neighbours of the triangles of a mesh.
struct SurfaceGeometry
{
  /// Keeps a reference to the mesh.
  explicit SurfaceGeometry(const TriangleMesh& given);

  const Eigen::Vector3d& Corner(int triangle, int corner) const
  {
    return this->mesh.points[this->mesh.triangles[triangle][corner]];
  }
  Eigen::Vector3d Middle(int triangle) const
  {
    return (this->Corner(triangle, 0) + this->Corner(triangle, 1) + this->Corner(triangle, 2)) / 3;
  }

  const TriangleMesh& mesh;
  std::vector<Eigen::Vector3d> normals; ///< unit; zero for a triangle without area
  std::vector<double> areas;
  std::vector<std::array<int, 3>> neighbors; ///< across the side after each corner, or -1
};

}

#endif
