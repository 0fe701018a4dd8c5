// SPDX-License-Identifier: BSD-3-Clause
#include "Texture/SurfaceGeometry.h"

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace freespace
{

SurfaceGeometry::SurfaceGeometry(const TriangleMesh& given)
  : mesh(given)
  , normals(given.triangles.size())
  , areas(given.triangles.size())
  , neighbors(given.triangles.size(), { -1, -1, -1 })
{
  std::unordered_map<std::uint64_t, std::pair<int, int>> open;
  for (std::size_t t = 0; t < given.triangles.size(); ++t)
  {
    const auto& corners = given.triangles[t];
    const Eigen::Vector3d& a = given.points[corners[0]];
    const Eigen::Vector3d normal =
      (given.points[corners[1]] - a).cross(given.points[corners[2]] - a);
    const double length = normal.norm();
    const bool usable = std::isfinite(length) && length > 0;
    this->areas[t] = usable ? length / 2 : 0;
    this->normals[t] = usable ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::Zero();
    for (int side = 0; side < 3; ++side)
    {
      const std::uint64_t from = corners[side];
      const std::uint64_t to = corners[(side + 1) % 3];
      const auto other = open.find(to << 32 | from);
      if (other != open.end())
      {
        this->neighbors[t][side] = other->second.first;
        this->neighbors[other->second.first][other->second.second] = static_cast<int>(t);
        open.erase(other);
      }
      else
      {
        open[from << 32 | to] = { static_cast<int>(t), side };
      }
    }
  }
}

}
