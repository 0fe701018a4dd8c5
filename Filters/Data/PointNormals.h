// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_PointNormals_h
#define freespace_PointNormals_h

#include "vtkFreespaceFiltersModule.h"

class vtkPolyData;

namespace freespace
{

/// Gives a surface the point data Normals: of unit length, out of the matter, the mean of the normals of a point's
/// triangles (vtkPolyDataNormals). Points are not split at sharp edges. Those that it had are replaced.
VTKFREESPACEFILTERS_EXPORT void ComputePointNormals(vtkPolyData* surface);

}

#endif
