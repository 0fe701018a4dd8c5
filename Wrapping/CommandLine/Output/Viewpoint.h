// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Viewpoint_h
#define freespace_Viewpoint_h

#include "Common/View.h"

#include <optional>
#include <string>
#include <vector>

class vtkMultiBlockDataSet;
class vtkPolyData;

namespace freespace
{

/// A viewpoint (NovelCameras.h) from which a reconstruction shows itself well, whatever way its axes go: by the
/// features of its disparity maps. Nothing without features.
std::optional<Camera> ViewpointOfMaps(vtkMultiBlockDataSet* maps);

/// The same by what the cameras see of a surface. Throws like ViewsOfSurface.
Camera ViewpointOfCameras(
  vtkMultiBlockDataSet* cameras, vtkPolyData* surface, const std::string& fileName);

/// Cameras, and as their features what they see of a surface. Throws Error naming their file where that is
/// nothing.
std::vector<View> ViewsOfSurface(
  vtkMultiBlockDataSet* cameras, vtkPolyData* surface, const std::string& fileName);

/// Gives a surface the viewpoint of the maps that it comes from, see SurfaceViewpoint.h.
void AddViewpoint(vtkMultiBlockDataSet* maps, vtkPolyData* surface);

}

#endif
