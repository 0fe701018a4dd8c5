// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Viewpoint_h
#define freespace_Viewpoint_h

#include "Common/View.h"

#include <vtkSmartPointer.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

class vtkMultiBlockDataSet;
class vtkPolyData;

namespace freespace
{

/// A good viewpoint (NovelCameras.h) of a reconstruction for any orientation of its axes, by the features of its
/// disparity maps. Empty without features.
/// Features beyond the bounds (x0, x1, y0, y1, z0, z1) of the surface do not count.
std::optional<Camera> ViewpointOfMaps(vtkMultiBlockDataSet* maps, const double bounds[6]);

/// The same by the points of a surface that the cameras see. Throws like ViewsOfSurface.
Camera ViewpointOfCameras(
  vtkMultiBlockDataSet* cameras, vtkPolyData* surface, const std::string& fileName);

/// Cameras, and as their features what they see of a surface. Throws Error naming their file where that is
/// nothing.
std::vector<View> ViewsOfSurface(
  vtkMultiBlockDataSet* cameras, vtkPolyData* surface, const std::string& fileName);

/// The view of a picture of another size; the same where that is not given, or there is no view.
vtkSmartPointer<vtkPolyData> Resized(
  vtkPolyData* view, const std::optional<std::array<int, 2>>& size);

/// Gives a surface the viewpoint of the maps that it comes from, see SurfaceViewpoint.h.
/// Features beyond the bounds do not count.
void AddViewpoint(vtkMultiBlockDataSet* maps, vtkPolyData* surface, const double bounds[6]);

}

#endif
