// SPDX-License-Identifier: BSD-3-Clause
#include "Output/Viewpoint.h"

#include "Common/Error.h"
#include "Data/ViewBlocks.h"
#include "Data/SurfaceMesh.h"
#include "Viewpoints/FramePoints.h"
#include "Viewpoints/NovelCameras.h"
#include "Viewpoints/VisiblePoints.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>

#include <optional>

namespace freespace
{

namespace
{

std::optional<Camera> BestCamera(const std::vector<View>& views)
{
  const std::vector<Camera> novel = NovelCameras(views, 1);
  return novel.empty() ? std::nullopt : std::optional<Camera>(novel[0]);
}

}

std::optional<Camera> ViewpointOfMaps(vtkMultiBlockDataSet* maps, const double bounds[6])
{
  const Eigen::AlignedBox3d box(Eigen::Vector3d(bounds[0], bounds[2], bounds[4]),
    Eigen::Vector3d(bounds[1], bounds[3], bounds[5]));
  std::vector<View> views;
  for (const DisparityMap& map : MapsFromBlocks(maps))
  {
    View view = map;
    view.points.clear();
    for (std::size_t i = 0; i < map.points.size(); ++i)
    {
      if (map.sourceView[i] == static_cast<int>(views.size()) && box.contains(map.points[i]))
      {
        view.points.push_back(map.points[i]);
      }
    }
    views.push_back(view);
  }
  return BestCamera(views);
}

std::vector<View> ViewsOfSurface(
  vtkMultiBlockDataSet* cameras, vtkPolyData* surface, const std::string& fileName)
{
  const TriangleMesh mesh = MeshFromPolyData(surface);
  std::vector<View> views = ViewsFromBlocks(cameras);
  bool isSeen = false;
  for (View& view : views)
  {
    view.points = VisiblePoints(mesh, view.camera);
    isSeen = isSeen || !view.points.empty();
  }
  if (!isSeen)
  {
    throw Error("No camera of " + fileName + " sees the surface: it is of another place.");
  }
  return views;
}

Camera ViewpointOfCameras(
  vtkMultiBlockDataSet* cameras, vtkPolyData* surface, const std::string& fileName)
{
  return *BestCamera(ViewsOfSurface(cameras, surface, fileName));
}

vtkSmartPointer<vtkPolyData> Resized(
  vtkPolyData* view, const std::optional<std::array<int, 2>>& size)
{
  if (!view || !size)
  {
    return view;
  }
  View resized;
  resized.camera = WithSize(ViewFromBlock(view, "to look from").camera, (*size)[0], (*size)[1]);
  return BlockFromView(resized);
}

void AddViewpoint(vtkMultiBlockDataSet* maps, vtkPolyData* surface, const double bounds[6])
{
  if (const auto viewpoint = ViewpointOfMaps(maps, bounds))
  {
    AddCamera(surface, *viewpoint, "");
  }
}

}
