// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ViewerModel_h
#define freespace_ViewerModel_h

#include "Common/Camera.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

class vtkMultiBlockDataSet;
class vtkPolyData;

namespace freespace
{

class Session;

/// Lines for cameras in one colour.
struct ViewerCameras
{
  std::array<std::uint8_t, 3> color;
  std::vector<Camera> cameras;
};

/// What the page's viewer (Report/SurfaceViewer.js) shows, small enough for a page.
struct ViewerModel
{
  std::string json;
  long long triangles = 0; ///< after simplification
};

/// The surface, simplified to at most `mostTriangles`, with a texture baked from the images, the
/// features (at most 60,000) in their colours, and the cameras. It is seen first as `first` sees it, turned
/// around `middle`. Throws Error when a stage fails.
///
/// Coordinates travel as 16 bits of the surface's box, indices as 32, all in base64.
ViewerModel MakeViewerModel(Session& session, vtkPolyData* surface,
  vtkMultiBlockDataSet* photographs, vtkMultiBlockDataSet* features,
  const std::vector<ViewerCameras>& cameras, const Camera& first, const Eigen::Vector3d& middle,
  int mostTriangles);

}

#endif
