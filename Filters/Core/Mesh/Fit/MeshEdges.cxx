// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Fit/MeshEdges.h"

#include "Common/GroupedLists.h"

#include <algorithm>

namespace freespace
{

MeshEdges::MeshEdges(const std::vector<std::array<std::int32_t, 3>>& triangles, std::size_t count)
  : ofTriangle(triangles.size())
  , opposite(triangles.size(), { -1, -1, -1 })
{
  const auto endsOf = [&](std::size_t side)
  {
    const auto& corners = triangles[side / 3];
    return std::minmax(corners[side % 3], corners[(side + 1) % 3]);
  };
  // The sides of triangles, by their lesser vertex.
  const std::size_t sides = 3 * triangles.size();
  GroupedLists<std::size_t, std::size_t> sorted(count,
    [&](const auto& add)
    {
      for (std::size_t side = 0; side < sides; ++side)
      {
        add(endsOf(side).first, side);
      }
    });
  sorted.SortLists(
    [&](std::size_t a, std::size_t b)
    {
      const int x = endsOf(a).second, y = endsOf(b).second;
      return x != y ? x < y : a < b;
    });
  this->ends.reserve(sides / 2);
  for (std::size_t v = 0; v < count; ++v)
  {
    const auto list = sorted[v];
    for (const std::size_t* from = list.begin(); from != list.end();)
    {
      const std::size_t* to = from;
      while (to != list.end() && endsOf(*to).second == endsOf(*from).second)
      {
        this->ofTriangle[*to / 3][*to % 3] = static_cast<std::int32_t>(this->ends.size());
        ++to;
      }
      if (to - from == 2)
      {
        this->opposite[from[0] / 3][from[0] % 3] = static_cast<std::int32_t>(from[1] / 3);
        this->opposite[from[1] / 3][from[1] % 3] = static_cast<std::int32_t>(from[0] / 3);
      }
      this->ends.push_back({ static_cast<std::int32_t>(v), endsOf(*from).second });
      from = to;
    }
  }
}

}
