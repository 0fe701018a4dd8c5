// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/OverlappingViews.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace freespace
{

using Eigen::AlignedBox2d;
using Eigen::AlignedBox3d;

namespace
{

// Room for what lies a little behind a surface, as a fraction of its depth.
constexpr double Room = 0.02;

// The pyramid from the camera's centre over all of the map's pixels to its deepest point.
AlignedBox3d ReachOf(const DisparityMap& map)
{
  AlignedBox2d pixels;
  double deepest = 0;
  for (std::size_t i = 0; i < map.points.size(); ++i)
  {
    const double depth = map.camera.Depth(map.points[i]);
    if (std::isfinite(depth) && depth > 0 && map.imagePoints[i].allFinite())
    {
      pixels.extend(map.imagePoints[i]);
      deepest = std::max(deepest, depth);
    }
  }
  AlignedBox3d reach;
  if (deepest > 0)
  {
    reach.extend(map.camera.Center());
    for (int corner = 0; corner < 4; ++corner)
    {
      const auto pixel = pixels.corner(static_cast<AlignedBox2d::CornerType>(corner));
      reach.extend(map.camera.Unproject(pixel, (1 + Room) * deepest));
    }
  }
  return reach;
}

}

std::vector<std::vector<int>> OverlappingViews(const std::vector<DisparityMap>& maps)
{
  std::vector<AlignedBox3d> reach;
  AlignedBox3d all;
  for (const DisparityMap& map : maps)
  {
    reach.push_back(ReachOf(map));
    all.extend(reach.back());
  }
  // A sweep along the longest axis: each is compared with those that have begun and not ended.
  int axis = 0;
  all.sizes().maxCoeff(&axis);
  std::vector<int> order(maps.size()), open;
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [&](int a, int b) { return reach[a].min()[axis] < reach[b].min()[axis]; });
  std::vector<std::vector<int>> overlapping(maps.size());
  for (int view : order)
  {
    const auto hasEnded = [&](int other)
    { return reach[other].max()[axis] < reach[view].min()[axis]; };
    open.erase(std::remove_if(open.begin(), open.end(), hasEnded), open.end());
    for (int other : open)
    {
      if (reach[view].intersects(reach[other]))
      {
        overlapping[view].push_back(other);
        overlapping[other].push_back(view);
      }
    }
    open.push_back(view);
  }
  for (std::vector<int>& others : overlapping)
  {
    std::sort(others.begin(), others.end());
  }
  return overlapping;
}

}
