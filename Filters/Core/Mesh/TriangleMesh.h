// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_TriangleMesh_h
#define freespace_TriangleMesh_h

#include <Eigen/Dense>

#include <array>
#include <vector>

namespace freespace
{

/// A surface of triangles, counter-clockwise from outside. Each index is that of a point.
struct TriangleMesh
{
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
};

}

#endif
