// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_PhotographBlocks_h
#define freespace_PhotographBlocks_h

#include "Texture/Photograph.h"
#include "Texture/TriangleMesh.h"
#include "vtkFreespaceRenderingModule.h"

class vtkMultiBlockDataSet;
class vtkPolyData;

namespace freespace
{

/// The photographs of a vtkPhotographReader. Throws Error naming the block that is not an image of
/// three or four unsigned chars with a camera of its size.
std::vector<Photograph> PhotographsFromBlocks(vtkMultiBlockDataSet* blocks);

/// The triangles of a surface; strips and larger polygons are cut into triangles.
VTKFREESPACERENDERING_EXPORT TriangleMesh MeshFromPolyData(vtkPolyData* surface);

}

#endif
