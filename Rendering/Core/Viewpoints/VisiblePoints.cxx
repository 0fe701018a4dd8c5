// SPDX-License-Identifier: BSD-3-Clause
#include "Viewpoints/VisiblePoints.h"

#include "Texture/DisparityImage.h"
#include "Viewpoints/FramePoints.h"

#include <algorithm>

namespace freespace
{

std::vector<Eigen::Vector3d> VisiblePoints(const TriangleMesh& mesh, const Camera& camera)
{
  constexpr int longest = 400;       // pixels of the depth buffer
  constexpr double tolerance = 0.01; // of disparity, over a sloping pixel
  const double scale = std::min(1.0, double(longest) / std::max(camera.width, camera.height));
  const Camera coarse = WithSize(camera, std::max(1, static_cast<int>(scale * camera.width)),
    std::max(1, static_cast<int>(scale * camera.height)));
  const DisparityImage nearest = RenderDisparity(mesh, coarse);
  std::vector<Eigen::Vector3d> visible;
  for (const Eigen::Vector3d& point : mesh.points)
  {
    const double depth = coarse.Depth(point);
    const Eigen::Vector2d pixel = coarse.Project(point);
    const bool isInside =
      depth > 0 && pixel.minCoeff() >= 0 && pixel.x() < coarse.width && pixel.y() < coarse.height;
    if (isInside &&
      1 / depth >=
        (1 - tolerance) * nearest.At(static_cast<int>(pixel.x()), static_cast<int>(pixel.y())))
    {
      visible.push_back(point);
    }
  }
  return visible;
}

}
