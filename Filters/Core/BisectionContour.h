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
  bool exact = true;       ///< take crossings from the field where it knows them, see
                           ///< ContourField::Crossing; the tolerance is for all others
  bool sharp = false;      ///< rebuild sharp edges and corners from the normals at the crossings
  double sharpAngle =
    60;           ///< between two normals of a cell that make it sharp, degrees; in (0, 180)
  int piece = 0;  ///< which of the pieces to make; in [0, pieces)
  int pieces = 1; ///< that together are the surface; >= 1
  double memoryLimit = 0; ///< for the piece and for making it, MiB; 0: none

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// Where a contour writes its mesh: three values to a point and to a triangle, one to a label.
/// Points go to either precision, the other is null; so may be the labels.
struct ContourArrays
{
  float* singlePoints = nullptr;
  double* doublePoints = nullptr;
  std::int32_t* triangles = nullptr; ///< counter-clockwise from the free side
  std::int32_t* view = nullptr;      ///< per triangle: the view that carved it, -1 the hull
  SurfaceKind* kind = nullptr;       ///< per triangle
};

/// How large a contour is.
struct ContourSize
{
  std::size_t points = 0;
  std::size_t ownPoints = 0; ///< of these: the points after them belong to other pieces
  std::size_t triangles = 0;
};

/// Provides the arrays when their sizes are known, so that no copy of a large mesh is made.
using AllocateContour = std::function<ContourArrays(const ContourSize& size)>;

/// The boundary of the matter within the bounds, by marching cubes whose vertices are found by
/// bisection (section 2.2, figure 6). What lies outside of the bounds counts as free, so that the
/// surface is closed.
///
/// The lattice is descended as an octree of boxes that the field classifies; where it cannot, every
/// point is asked. The work is cut into blocks that depend on the lattice alone, so the mesh is the
/// same for any number of threads. The surface is closed, 2-manifold and oriented for any field.
///
/// With `sharp` on it is extended marching cubes (Kobbelt, Botsch, Schwanecke, Seidel, "Feature
/// sensitive surface extraction from volume data", SIGGRAPH 2001): a cell whose crossings have normals
/// that differ by more than the sharp angle gets a vertex where the crossings' planes meet, and edges
/// are flipped to join such vertices of neighbouring cells. Normals are smoothed over about a cell
/// first: what is finer than the lattice neither makes nor hides an edge. Beyond the paper:
/// - A cell also takes an edge or corner that only its neighbours' planes show, and matter hangs
///   together across the diagonal of a face whose middle is matter.
/// - A wedge may dip into cells without holding any of their lattice points; the vertex of the cell
///   next to it is put there.
/// - A vertex that the field puts half a cell or more off the surface is moved onto it within its cell,
///   or left out where the cell does not have it.
/// - What reaches out of its cells, or is not shown by the cell's own planes, the field must confirm;
///   and it gives way where its triangles would meet others, by a rule that looks at the surroundings
///   alone. So the surface never meets itself.
///
/// Pieces share out the lattice. A piece is open where it meets others, and has exactly their
/// vertices there: all pieces' own points, one piece after the other, are the points of the whole, and
/// so are their triangles, in the same order.
///
/// What is held beside the mesh is small, and let go while the mesh is written. Throws Error before the
/// work when the surface will not fit into the memory limit, see EstimateContour; and when it comes out
/// larger than that. Throws Aborted when
/// the progress wants to stop; what was written then is of no use.
void BisectionContour(const ContourField& field, const Eigen::AlignedBox3d& bounds,
  const ContourOptions& options, const AllocateContour& allocate, const Progress& progress = {},
  const ParallelFor& parallelFor = SerialFor);

/// Whether points in single precision keep the surface free of degenerate triangles.
bool SinglePrecisionSuffices(const Eigen::AlignedBox3d& bounds, const ContourOptions& options);

/// A mesh of its own, for callers without arrays.
struct ContourMesh
{
  std::vector<Eigen::Vector3d> points;
  std::size_t ownPoints = 0;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> view;
  std::vector<SurfaceKind> kind;
};

ContourMesh BisectionContour(const ContourField& field, const Eigen::AlignedBox3d& bounds,
  const ContourOptions& options, const Progress& progress = {},
  const ParallelFor& parallelFor = SerialFor);

}

#endif
