// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Lattice_h
#define freespace_Lattice_h

#include <Eigen/Geometry>

#include <array>
#include <vector>

namespace freespace
{

/// Indices along the axes of a lattice: of points, cells or blocks.
using LatticeIndex = std::array<int, 3>;

/// The regular lattice of a contour. Cells are cubes.
struct ContourLattice
{
  Eigen::Vector3d origin; ///< the first point
  double spacing = 0.0;   ///< between points
  LatticeIndex cells;     ///< along each axis; there is one point more

  /// The lattice for a box: its outermost points are at least half a cell outside of the box, so
  /// that the box's faces are crossed between points.
  ContourLattice(const Eigen::AlignedBox3d& bounds, int cellsAlongLongestSide);

  Eigen::Vector3d Point(int i, int j, int k) const
  {
    return this->origin + this->spacing * Eigen::Vector3d(i, j, k);
  }
};

/// A range of cells along each axis, from low up to but without high.
struct CellRange
{
  LatticeIndex low, high;

  int Longest() const;
  Eigen::AlignedBox3d Box(const ContourLattice& lattice) const;

  /// The up to eight parts of the range when it is halved along each axis at a multiple of the
  /// step, in a fixed order.
  std::vector<CellRange> Parts(int step) const;
};

}

#endif
