// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SurfaceMesh_h
#define freespace_SurfaceMesh_h

#include "Mesh/TriangleMesh.h"
#include "vtkFreespaceFiltersModule.h"

class vtkPolyData;

namespace freespace
{

/// The triangles of a surface; strips and larger polygons are cut into triangles.
VTKFREESPACEFILTERS_EXPORT TriangleMesh MeshFromPolyData(vtkPolyData* surface);

}

#endif
