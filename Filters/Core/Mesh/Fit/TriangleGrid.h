// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_TriangleGrid_h
#define freespace_TriangleGrid_h

#include "Mesh/BoxGrid.h"
#include "Mesh/NearestOnTriangle.h"

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <vector>

namespace freespace
{

/// A point on a triangle, by the barycentric weights of its corners.
struct TrianglePlace
{
  int triangle = -1; ///< -1: none
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();
};

/// A spatial index of the triangles of a mesh. Keeps references to both arrays.
class TriangleGrid
{
public:
  using Triangles = std::vector<std::array<std::int32_t, 3>>;

  /// Cells should be somewhat larger than the triangles. O(n log n).
  TriangleGrid(const std::vector<Eigen::Vector3d>& points, const Triangles& triangles, double cell);

  /// The nearest point within a reach on the triangles that face an eye looking along a direction. A triangle that is
  /// probably near (-1: none) makes it faster and no different.
  TrianglePlace Nearest(const Eigen::Vector3d& point, const Eigen::Vector3d& direction,
    double reach, int hint = -1) const;

private:
  /// A sphere around a triangle and its plane, so that most are rejected without a look at its corners.
  struct Bounds
  {
    Eigen::Vector3d center;
    double radius;
    Eigen::Vector3d normal; ///< its length is twice the triangle's area
    double squaredNormal;
  };

  void FindBounds();
  bool IsFarther(int triangle, const Eigen::Vector3d& point, const Eigen::Vector3d& direction,
    double distance) const;
  void Compare(
    int triangle, const Eigen::Vector3d& point, TrianglePlace& place, double& distance) const;
  void Look(const Eigen::Vector3d& point, const Eigen::Vector3d& direction, double reach,
    TrianglePlace& place, double& distance) const;

  const std::vector<Eigen::Vector3d>& Points;
  const Triangles& Corners;
  double Side;                // of a cell
  std::vector<Bounds> Around; // per triangle
  BoxGrid Grid;
};

}

#endif
