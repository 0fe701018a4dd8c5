// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/Background/BridgedMap.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

// The least depth of a jump, in units of the noise.
constexpr double LeastJump = 10;

}

BridgedMap::BridgedMap(
  const DisparityMap& given, const BackgroundOptions& options, const CancellationFlag& stop)
  : map(given)
  , freespace(given, stop)
  , isBridge(given.triangles.size())
{
  this->disparity.reserve(given.points.size());
  for (const Vector3d& point : given.points)
  {
    this->disparity.push_back(1 / given.camera.Depth(point));
  }
  for (std::size_t t = 0; t < given.triangles.size(); ++t)
  {
    ThrowIfCancelled(stop);
    this->isBridge[t] = this->Spans(t, options);
  }
  this->sound = GroupedLists<int>(given.points.size(),
    [&](const auto& add)
    {
      for (std::size_t t = 0; t < given.triangles.size(); ++t)
      {
        for (int corner : given.triangles[t])
        {
          if (!this->isBridge[t])
          {
            add(corner, static_cast<int>(t));
          }
        }
      }
    });
}

// Whether a triangle spans a depth jump: far deeper than noise, and at grazing incidence.
bool BridgedMap::Spans(std::size_t triangle, const BackgroundOptions& options) const
{
  const auto [a, b, c] = this->map.triangles[triangle];
  const auto [far, near] =
    std::minmax({ this->disparity[a], this->disparity[b], this->disparity[c] });
  const Vector3d& p = this->map.points[a];
  const Vector3d& q = this->map.points[b];
  const Vector3d& r = this->map.points[c];
  const Vector3d normal = (q - p).cross(r - p);
  const Vector3d sight = (p + q + r) / 3 - this->map.camera.Center();
  return near > far * (1 + LeastJump * options.noise) &&
    std::abs(normal.dot(sight)) <
    std::cos(options.grazingAngle * M_PI / 180) * normal.norm() * sight.norm();
}

BridgeMask::BridgeMask(const BridgedMap& bridged)
  : Touched(Tiles * Tiles, 0)
{
  const DisparityMap& map = bridged.map;
  for (const auto& triangle : map.triangles)
  {
    for (int corner : triangle)
    {
      this->Box.extend(map.imagePoints[corner]);
    }
  }
  this->TilesPerPixel = Tiles / this->Box.sizes().array().max(1e-9);
  for (std::size_t t = 0; t < map.triangles.size(); ++t)
  {
    if (bridged.isBridge[t])
    {
      const auto [a, b, c] = map.triangles[t];
      Eigen::AlignedBox2d box(map.imagePoints[a]);
      box.extend(map.imagePoints[b]).extend(map.imagePoints[c]);
      const Eigen::Array2i first = this->Tile(box.min()), last = this->Tile(box.max());
      for (int y = first.y(); y <= last.y(); ++y)
      {
        std::fill(
          &this->Touched[Index({ first.x(), y })], &this->Touched[Index({ last.x(), y })] + 1, 1);
      }
    }
  }
}

}
