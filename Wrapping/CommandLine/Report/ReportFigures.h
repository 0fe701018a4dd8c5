// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ReportFigures_h
#define freespace_ReportFigures_h

#include "Common/Camera.h"
#include "Report/Page/ReportPage.h"

#include <string>
#include <vector>

class vtkMultiBlockDataSet;
class vtkPolyData;

namespace freespace
{

class Session;
struct Scene;

/// The pictures of a report. Each is written in full size as a PNG into a folder, and embedded in the page as a
/// smaller JPEG. All throw Error when a picture cannot be made.

/// Figure 8: each view's image and its features over it. At most `most` views, evenly chosen.
std::vector<ReportView> FeatureFigures(Session& session, const Scene& scene,
  vtkMultiBlockDataSet* features, const std::string& folder, int most);

/// Figure 10: all features in their colours.
std::vector<ReportPicture> CloudFigures(Session& session, vtkMultiBlockDataSet* features,
  const std::vector<Camera>& cameras, const std::string& folder);

/// Figure 11: the surface.
std::vector<ReportPicture> SurfaceFigures(Session& session, vtkPolyData* surface,
  const std::vector<Camera>& cameras, const std::string& folder);

/// Figure 12: the surface in the images' colours.
std::vector<ReportPicture> TexturedFigures(Session& session, vtkPolyData* surface,
  vtkMultiBlockDataSet* photographs, const std::vector<Camera>& cameras, const std::string& folder);

}

#endif
