// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_MeshEdges_h
#define freespace_MeshEdges_h

#include <array>
#include <cstdint>
#include <vector>

namespace freespace
{

/// The edges of a triangle mesh and the triangles beside them.
struct MeshEdges
{
  /// Of `count` vertices. An edge of more than two triangles has no opposite ones. O(n).
  MeshEdges(const std::vector<std::array<std::int32_t, 3>>& triangles, std::size_t count);

  std::vector<std::array<std::int32_t, 2>> ends; ///< of each edge, the lesser vertex first
  /// Per triangle, the edge from corner i to corner i + 1.
  std::vector<std::array<std::int32_t, 3>> ofTriangle;
  /// Per triangle, the one beyond the edge from corner i to corner i + 1; -1: a border.
  std::vector<std::array<std::int32_t, 3>> opposite;
};

}

#endif
