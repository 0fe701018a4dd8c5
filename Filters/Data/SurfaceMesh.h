// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SurfaceMesh_h
#define freespace_SurfaceMesh_h

#include "Mesh/TriangleMesh.h"
#include "vtkFreespaceFiltersModule.h"

#include <vtkSmartPointer.h>

#include <Eigen/Core>

class vtkPoints;
class vtkPolyData;

namespace freespace
{

/// The triangles of a surface; strips and larger polygons are cut into triangles.
VTKFREESPACEFILTERS_EXPORT TriangleMesh MeshFromPolyData(vtkPolyData* surface);

/// The points of a surface plus an offset, in double precision.
VTKFREESPACEFILTERS_EXPORT vtkSmartPointer<vtkPoints> MovedPoints(
  vtkPolyData* surface, const Eigen::Vector3d& offset);

}

#endif
