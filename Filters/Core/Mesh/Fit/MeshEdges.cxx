// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Fit/MeshEdges.h"

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
  std::vector<std::size_t> begin(count + 2, 0), sorted(sides);
  for (std::size_t side = 0; side < sides; ++side)
  {
    ++begin[endsOf(side).first + 2];
  }
  for (std::size_t i = 2; i < begin.size(); ++i)
  {
    begin[i] += begin[i - 1];
  }
  for (std::size_t side = 0; side < sides; ++side)
  {
    sorted[begin[endsOf(side).first + 1]++] = side;
  }
  this->ends.reserve(sides / 2);
  for (std::size_t v = 0; v < count; ++v)
  {
    const auto first = sorted.begin() + begin[v], last = sorted.begin() + begin[v + 1];
    std::sort(first, last,
      [&](std::size_t a, std::size_t b)
      {
        const int x = endsOf(a).second, y = endsOf(b).second;
        return x != y ? x < y : a < b;
      });
    for (auto from = first; from != last;)
    {
      auto to = from;
      while (to != last && endsOf(*to).second == endsOf(*from).second)
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
