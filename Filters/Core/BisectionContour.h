// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BisectionContour_h
#define freespace_BisectionContour_h

#include "ContourField.h"
#include "ParallelFor.h"
#include "Progress.h"

#include <array>
#include <cstdint>

namespace freespace
{

/// How a field is contoured.
struct ContourOptions
{
  int cells = 256;         ///< of the lattice along its longest side; >= 2
  double tolerance = 1e-3; ///< of the bisection, as a fraction of a cell; in (0, 0.5]
  double clearance = 0.01; ///< vertices keep so far from the lattice's points, as a fraction of a
                           ///< cell, lest triangles vanish; in (0, 0.25]

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// The regular lattice that a contour is taken over. Cells are cubes.
struct ContourLattice
{
  Eigen::Vector3d origin;   ///< the first point
  double spacing = 0.0;     ///< between points
  std::array<int, 3> cells; ///< along each axis; there is one point more

  /// The lattice for a box: its outermost points lie half a cell (or more) outside of the box, so
  /// that the box's faces are crossed between points.
  ContourLattice(const Eigen::AlignedBox3d& bounds, int cellsAlongLongestSide);

  Eigen::Vector3d Point(int i, int j, int k) const
  {
    return this->origin + this->spacing * Eigen::Vector3d(i, j, k);
  }
};

/// A triangle mesh whose triangles know what they are.
struct ContourMesh
{
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::int32_t, 3>> triangles; ///< counter-clockwise from the free side
  std::vector<std::int32_t> view;                     ///< per triangle: that carved it, -1 the hull
  std::vector<SurfaceKind> kind;                      ///< per triangle
};

/// The boundary of the matter within the bounds, by marching cubes whose vertices are found by
/// bisection (section 2.2, figure 6). What lies outside of the bounds counts as free, so that the
/// surface is closed.
///
/// The lattice is descended as an octree of boxes that the field classifies; where it cannot, every
/// point is asked. The work is cut into blocks that depend on the lattice alone, so the mesh is the
/// same for any number of threads. The surface is closed, 2-manifold and oriented for any field.
ContourMesh BisectionContour(const ContourField& field, const Eigen::AlignedBox3d& bounds,
  const ContourOptions& options, const Progress& progress = {},
  const ParallelFor& parallelFor = SerialFor);

}

#endif
