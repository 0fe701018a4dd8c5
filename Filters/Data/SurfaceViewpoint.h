// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SurfaceViewpoint_h
#define freespace_SurfaceViewpoint_h

#include "Common/Camera.h"
#include "vtkFreespaceFiltersModule.h"

#include <optional>
#include <string>

class vtkPolyData;

namespace freespace
{

/// The viewpoint of a surface: a camera in its field data, as in a view's block. A .ply stores it in a
/// comment, so that an image of the file alone is upright and shows the observed side.

/// The surface's viewpoint; nothing if it has none or an invalid one.
VTKFREESPACEFILTERS_EXPORT std::optional<Camera> ViewpointOf(vtkPolyData* surface);

/// The comment of a .ply for the viewpoint, in one line; empty if the surface has none.
VTKFREESPACEFILTERS_EXPORT std::string ViewpointComment(vtkPolyData* surface);

/// The viewpoint of such a comment; nothing for any other comment.
VTKFREESPACEFILTERS_EXPORT std::optional<Camera> ViewpointFromComment(const std::string& comment);

}

#endif
