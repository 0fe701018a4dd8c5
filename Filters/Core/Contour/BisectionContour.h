// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BisectionContour_h
#define freespace_BisectionContour_h

#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Contour/Lattice/ContourField.h"
#include "Contour/Lattice/ContourMesh.h"
#include "Contour/Lattice/ContourOptions.h"

namespace freespace
{

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

ContourMesh BisectionContour(const ContourField& field, const Eigen::AlignedBox3d& bounds,
  const ContourOptions& options, const Progress& progress = {},
  const ParallelFor& parallelFor = SerialFor);

}

#endif
