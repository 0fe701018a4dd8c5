// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ObservedTriangles_h
#define freespace_ObservedTriangles_h

#include "vtkFreespaceFiltersModule.h"

class vtkPolyData;

namespace freespace
{

/// Drops all triangles of a contour but those of feature triangles (cell array Kind), and the points
/// that only they had. A surface without that array is left as it is.
VTKFREESPACEFILTERS_EXPORT void KeepObserved(vtkPolyData* surface);

}

#endif
