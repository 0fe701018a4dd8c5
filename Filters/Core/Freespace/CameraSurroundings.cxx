// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/CameraSurroundings.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

// Maximum number of the region's features whose distance is evaluated.
constexpr std::size_t AskedFeatures = 20000;
constexpr std::size_t Nearest = 1000; // this part of them may be wrong

double DistanceToNearest(const std::vector<Vector3d>& features, const Vector3d& center)
{
  const std::size_t count = std::min(AskedFeatures, features.size());
  std::vector<double> distances;
  for (std::size_t i = 0; i < count; ++i)
  {
    distances.push_back((features[i * features.size() / count] - center).norm());
  }
  const auto low = distances.begin() + static_cast<std::ptrdiff_t>(count / Nearest);
  std::nth_element(distances.begin(), low, distances.end());
  return *low;
}

// One side of a cube around a camera's centre.
DisparityMap Face(const Vector3d& center, int axis, double sign, double halfSide, int view)
{
  DisparityMap map;
  map.name = "camera";
  Camera& camera = map.camera;
  camera.K << 1, 0, 1, 0, 1, 1, 0, 0, 1;
  camera.width = camera.height = 2;
  const Vector3d z = sign * Vector3d::Unit(axis), x = Vector3d::Unit((axis + 1) % 3);
  camera.R << x.transpose(), z.cross(x).transpose(), z.transpose();
  camera.t = -camera.R * center;
  for (int corner = 0; corner < 4; ++corner)
  {
    map.imagePoints.emplace_back(corner % 2 * 2.0, corner / 2 * 2.0);
    map.points.push_back(camera.Unproject(map.imagePoints.back(), halfSide));
    map.sourceView.push_back(view);
  }
  map.triangles = { { 0, 1, 3 }, { 0, 3, 2 } };
  return map;
}

}

std::vector<DisparityMap> CameraSurroundings(
  const std::vector<ViewFeatures>& views, const RegionHull& region, double share)
{
  std::vector<DisparityMap> maps;
  for (std::size_t v = 0; v < views.size() && share > 0 && !region.features.empty(); ++v)
  {
    const Vector3d center = views[v].camera.Center();
    const int plane = region.hull->NearestOfAll(center);
    if (plane < 0 || region.hull->Distance(plane, center) > 0)
    {
      continue;
    }
    // The corners of the cube are farther than its sides.
    const double halfSide = share / std::sqrt(3.0) * DistanceToNearest(region.features, center);
    for (int side = 0; side < 6 && halfSide > 0; ++side)
    {
      maps.push_back(
        Face(center, side / 2, side % 2 == 0 ? 1.0 : -1.0, halfSide, static_cast<int>(v)));
    }
  }
  return maps;
}

}
