// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SharpVertexFinder_h
#define freespace_SharpVertexFinder_h

#include "Contour/Sharp/BlockMesh.h"

namespace freespace
{

/// Adds a vertex to each cell of a contour that contains a sharp edge or corner: where the tangent
/// planes at the cell's crossings intersect, or on an edge that only the planes of adjacent cells
/// show. Some vertices lie outside of their cells, and their triangles may intersect others; see
/// JoinSharpVertices. A cell is sharp when two of its normals differ by the sharp angle (degrees)
/// or more.
///
/// Kobbelt, Botsch, Schwanecke, Seidel, "Feature sensitive surface extraction from volume data",
/// SIGGRAPH 2001.
void FindSharpEdges(const BoundedField& field, double sharpAngle, BlockMesh& blocks,
  const Progress& progress, const ParallelFor& parallelFor);

}

#endif
