// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SurfaceComponents_h
#define freespace_SurfaceComponents_h

#include <array>
#include <cstdint>
#include <vector>

namespace freespace
{

/// The connected components of a triangle mesh, by its points: for each triangle the number of its component,
/// in the order in which the triangles name them first. O(n).
std::vector<std::int32_t> ComponentsOf(
  const std::vector<std::array<std::int64_t, 3>>& triangles, std::int64_t points);

/// For each triangle whether its component is no crumb: one of its triangles is supported, or it has the most
/// triangles of all (the first of those).
std::vector<char> SupportedComponents(
  const std::vector<std::int32_t>& component, const std::vector<char>& isSupported);

}

#endif
