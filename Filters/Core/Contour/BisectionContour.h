// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BisectionContour_h
#define freespace_BisectionContour_h

#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Contour/KeptContour.h"
#include "Contour/Lattice/ContourField.h"
#include "Contour/Lattice/ContourMesh.h"
#include "Contour/Lattice/ContourOptions.h"

namespace freespace
{

/// The boundary of the matter within the bounds, by marching cubes whose vertices are found by
/// bisection (section 2.2, figure 6). All space outside the bounds is free, so that the surface is
/// closed.
///
/// The lattice is traversed as an octree of boxes that the field classifies; where it cannot, every
/// point is evaluated. The work is divided into blocks that depend only on the lattice, so the mesh does
/// not depend on the number of threads. It is closed, 2-manifold and oriented for any field.
///
/// With `sharp` on it is extended marching cubes (Kobbelt, Botsch, Schwanecke, Seidel, "Feature
/// sensitive surface extraction from volume data", SIGGRAPH 2001): a cell whose crossings have normals
/// that differ by more than the sharp angle gets a vertex where the crossings' planes meet, and edges
/// are flipped to join such vertices of neighbouring cells. Normals are smoothed over about a cell
/// first: details finer than the lattice neither create nor hide an edge. Beyond that paper:
/// - A cell also gets an edge or corner that only the planes of its neighbours show, and matter is
///   connected across the diagonal of a face whose centre is matter.
/// - A wedge may reach into cells without containing any of their lattice points; the vertex of the
///   adjacent cell is placed there.
/// - A vertex that is half a cell or more off the surface, according to the field, is moved onto it
///   within its cell, or omitted if the surface is not in the cell.
/// - A vertex outside its cell, or one that the cell's own planes do not show, must be confirmed by the
///   field, and is dropped where its triangles would intersect others, by a rule that depends only on
///   the surroundings. So the surface has no self-intersections.
///
/// Pieces partition the lattice. A piece is open where it meets others, and has the identical vertices
/// there: the own points of all pieces, one piece after the other, are the points of the whole, and so
/// are their triangles, in the same order.
///
/// Little memory is needed besides the mesh, and it is released while the mesh is written. Throws Error
/// in advance if the surface does not fit into the memory limit, see EstimateContour, and when it turns
/// out to be larger. Throws Aborted when
/// the progress stops it; the output is then undefined.
void BisectionContour(const ContourField& field, const Eigen::AlignedBox3d& bounds,
  const ContourOptions& options, const AllocateContour& allocate, const Progress& progress = {},
  const ParallelFor& parallelFor = SerialFor);

/// The same, but keeps its blocks for the next contour and reuses those of the last one that the change of the field
/// since then does not reach; null: the change is not known, and none is reused. The mesh is the same. Nothing is kept
/// of a piece, nor after an exception.
void BisectionContour(const ContourField& field, const Eigen::AlignedBox3d& bounds,
  const ContourOptions& options, const AllocateContour& allocate, KeptContour& kept,
  const FieldChange* change, const Progress& progress = {},
  const ParallelFor& parallelFor = SerialFor);

ContourMesh BisectionContour(const ContourField& field, const Eigen::AlignedBox3d& bounds,
  const ContourOptions& options, const Progress& progress = {},
  const ParallelFor& parallelFor = SerialFor);

}

#endif
