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

/// From where a surface shows itself well: a camera in its field data, as in a view's block. A .ply
/// keeps it in a comment, so that a picture of the file alone is upright and shows what was seen.

/// The surface's viewpoint; nothing where it has none, or one that is no camera.
VTKFREESPACEFILTERS_EXPORT std::optional<Camera> ViewpointOf(vtkPolyData* surface);

/// What a .ply says of the viewpoint, in one line; empty where the surface has none.
VTKFREESPACEFILTERS_EXPORT std::string ViewpointComment(vtkPolyData* surface);

/// The viewpoint of such a comment; nothing where the comment tells of something else.
VTKFREESPACEFILTERS_EXPORT std::optional<Camera> ViewpointFromComment(const std::string& comment);

}

#endif
