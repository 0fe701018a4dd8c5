// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SharpVertexJoiner_h
#define freespace_SharpVertexJoiner_h

#include "Contour/Sharp/BlockMesh.h"

namespace freespace
{

/// Decides which sharp vertices stay outside of their cells and which are joined by an edge that
/// does not pass through the face between their cells, so that the surface has no
/// self-intersections. Where two triangles would intersect, the choice of the greater rank is
/// dropped; each choice depends only on its surroundings. isSingle: points will be written in
/// single precision.
void JoinSharpVertices(
  bool isSingle, BlockMesh& blocks, const Progress& progress, const ParallelFor& parallelFor);

}

#endif
