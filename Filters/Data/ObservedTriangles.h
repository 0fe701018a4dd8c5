// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ObservedTriangles_h
#define freespace_ObservedTriangles_h

#include "vtkFreespaceFiltersModule.h"

class vtkPolyData;

namespace freespace
{

/// Which triangles of a contour are kept.
struct TriangleSelection
{
  bool observedOnly = false; ///< only those that KeepObserved keeps
  bool crumbs = false;       ///< also the components that DropCrumbs drops
};

/// The name of the cell array that tells, by 1, which triangles of a contour have a feature beside them.
extern VTKFREESPACEFILTERS_EXPORT const char* const SupportedName;

/// Drops all triangles of a contour that neither are of a feature triangle (cell array Kind) nor have a feature
/// beside them (Supported, where it is there), and the points that only they had. All other data stay. A
/// surface without a Kind is left as it is.
VTKFREESPACEFILTERS_EXPORT void KeepObserved(vtkPolyData* surface);

/// Drops the connected components of a contour of which no triangle has a feature beside it, but never the
/// largest. A surface without that array is left as it is.
VTKFREESPACEFILTERS_EXPORT void DropCrumbs(vtkPolyData* surface);

}

#endif
