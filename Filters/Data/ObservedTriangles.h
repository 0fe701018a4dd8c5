// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ObservedTriangles_h
#define freespace_ObservedTriangles_h

#include "vtkFreespaceFiltersModule.h"

#include <cstdint>

class vtkPolyData;

namespace freespace
{

/// Which triangles of a contour are kept.
struct TriangleSelection
{
  bool observedOnly = false; ///< only those that KeepObserved keeps
  bool crumbs = false;       ///< also the components that DropCrumbs drops
};

/// The name of the cell array that is 1 for triangles of a contour that are close to a feature.
extern VTKFREESPACEFILTERS_EXPORT const char* const SupportedName;

/// Drops all triangles of a contour that are neither on a feature triangle (cell array Kind) nor close to a
/// feature (Supported, if present), and the points that only they use. All other data are kept. A surface
/// without a Kind is unchanged.
VTKFREESPACEFILTERS_EXPORT void KeepObserved(vtkPolyData* surface);

/// Drops triangles that have the same corners in the same order of rotation as an earlier one. They add nothing,
/// and neighbors by edges would be sought among all of them.
VTKFREESPACEFILTERS_EXPORT void DropRepeated(vtkPolyData* surface);

/// Drops the connected components of a contour without a triangle that is close to a feature, except the
/// largest one. A surface without that array is unchanged. The number of triangles dropped.
VTKFREESPACEFILTERS_EXPORT std::int64_t DropCrumbs(vtkPolyData* surface);

}

#endif
