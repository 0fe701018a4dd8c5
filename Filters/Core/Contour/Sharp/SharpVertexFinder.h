// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SharpVertexFinder_h
#define freespace_SharpVertexFinder_h

#include "Contour/Sharp/BlockMesh.h"

namespace freespace
{

/// Gives cells of a contour that sharp edges and corners pass a vertex there: where the planes at
/// the cell's crossings meet, or at an edge that only its neighbours' planes show. Some lie beyond
/// their cells, and their triangles may meet others; see JoinSharpVertices. Two normals in a cell
/// that differ by the sharp angle (degrees) make it sharp.
///
/// Kobbelt, Botsch, Schwanecke, Seidel, "Feature sensitive surface extraction from volume data",
/// SIGGRAPH 2001.
void FindSharpEdges(const BoundedField& field, double sharpAngle, BlockMesh& blocks,
  const Progress& progress, const ParallelFor& parallelFor);

}

#endif
