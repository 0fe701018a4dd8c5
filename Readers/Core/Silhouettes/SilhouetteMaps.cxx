// SPDX-License-Identifier: BSD-3-Clause
#include "Silhouettes/SilhouetteMaps.h"

#include "Images/ImageMask.h"
#include "Images/LensDistortion.h"
#include "Sharing/MakeAll.h"
#include "Sharing/ViewBytes.h"
#include "Silhouettes/MaskTriangles.h"

#include <algorithm>

namespace freespace
{

using Eigen::AlignedBox3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

AlignedBox3d BoundsOf(const std::vector<EdgeView>& views)
{
  AlignedBox3d box;
  for (const EdgeView& view : views)
  {
    for (const Vector3d& point : view.points)
    {
      box.extend(point);
    }
  }
  return box;
}

// Twice as far away as any place of the box.
double DepthBehind(const Camera& camera, const AlignedBox3d& box)
{
  double depth = 0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const auto type = static_cast<AlignedBox3d::CornerType>(corner);
    depth = std::max(depth, 2 * camera.Depth(box.corner(type)));
  }
  return depth;
}

DisparityMap SilhouetteMap(const CalibratedImage& image, const PlanarTriangles& black, double depth)
{
  DisparityMap map;
  map.name = image.file + " (mask)";
  map.imageFile = image.file;
  map.camera = image.camera;
  const std::vector<Vector2d> pixels = UndistortPixels(image, black.points);
  std::vector<int> indices(pixels.size(), -1);
  for (std::size_t i = 0; i < pixels.size(); ++i)
  {
    if (pixels[i].allFinite()) // a fisheye lens sees more than its pinhole camera
    {
      indices[i] = static_cast<int>(map.points.size());
      map.imagePoints.push_back(pixels[i]);
      map.points.push_back(image.camera.Unproject(pixels[i], depth));
      map.sourceView.push_back(-1);
    }
  }
  for (const auto& [a, b, c] : black.triangles)
  {
    if (indices[a] >= 0 && indices[b] >= 0 && indices[c] >= 0)
    {
      map.triangles.push_back({ indices[a], indices[b], indices[c] });
    }
  }
  return map;
}

}

std::vector<DisparityMap> SilhouetteMaps(const Scene& scene,
  const std::vector<CalibratedImage>& images, const std::vector<EdgeView>& views,
  const ParallelFor& parallelFor, const Progress& progress)
{
  const AlignedBox3d box = BoundsOf(views);
  std::vector<DisparityMap> maps = MakeAll<DisparityMap>(images.size(), parallelFor, progress,
    [&](std::size_t i, const CancellationFlag& stop)
    {
      ThrowIfCancelled(stop);
      const Camera& camera = images[i].camera;
      const cv::Mat mask = LoadMask(scene.MaskPath(images[i].file), camera.width, camera.height);
      const double depth = box.isEmpty() ? 0 : DepthBehind(camera, box);
      return !mask.empty() && depth > 0 ? SilhouetteMap(images[i], MaskTriangles(mask), depth)
                                        : DisparityMap();
    });
  maps.erase(std::remove_if(maps.begin(), maps.end(),
               [](const DisparityMap& map) { return map.triangles.empty(); }),
    maps.end());
  return maps;
}

}
