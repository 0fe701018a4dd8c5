// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SharpVertexJoiner_h
#define freespace_SharpVertexJoiner_h

#include "Contour/Sharp/BlockMesh.h"

namespace freespace
{

/// Decides which sharp vertices stay beyond their cells and which are joined by an edge that does not
/// pass through the face between their cells, so that the surface never meets itself. Wherever two
/// triangles would meet, the choice of the greater rank gives way; each depends on its surroundings
/// alone. isSingle: points will be written in single precision.
void JoinSharpVertices(
  bool isSingle, BlockMesh& blocks, const Progress& progress, const ParallelFor& parallelFor);

}

#endif
