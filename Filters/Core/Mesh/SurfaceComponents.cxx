// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/SurfaceComponents.h"

#include <algorithm>
#include <numeric>

namespace freespace
{

std::vector<std::int32_t> ComponentsOf(
  const std::vector<std::array<std::int64_t, 3>>& triangles, std::int64_t points)
{
  // Union-find: each point goes to its parent, halfway to the root on every search.
  std::vector<std::int64_t> parent(points);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&parent](std::int64_t point)
  {
    while (parent[point] != point)
    {
      parent[point] = parent[parent[point]];
      point = parent[point];
    }
    return point;
  };
  for (const auto& [a, b, c] : triangles)
  {
    const std::int64_t lowest = std::min({ root(a), root(b), root(c) });
    for (std::int64_t corner : { a, b, c })
    {
      parent[root(corner)] = lowest;
    }
  }
  std::vector<std::int32_t> number(points, -1), component;
  component.reserve(triangles.size());
  std::int32_t next = 0;
  for (const auto& triangle : triangles)
  {
    std::int32_t& its = number[root(triangle[0])];
    its = its < 0 ? next++ : its;
    component.push_back(its);
  }
  return component;
}

std::vector<char> SupportedComponents(
  const std::vector<std::int32_t>& component, const std::vector<char>& isSupported)
{
  if (component.empty())
  {
    return {};
  }
  const std::size_t count = *std::max_element(component.begin(), component.end()) + 1;
  std::vector<std::size_t> size(count, 0);
  std::vector<char> isKept(count, 0);
  for (std::size_t t = 0; t < component.size(); ++t)
  {
    ++size[component[t]];
    isKept[component[t]] = isKept[component[t]] || isSupported[t];
  }
  isKept[std::max_element(size.begin(), size.end()) - size.begin()] = 1;
  std::vector<char> kept;
  kept.reserve(component.size());
  for (std::int32_t its : component)
  {
    kept.push_back(isKept[its]);
  }
  return kept;
}

}
