// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_MapEdges_h
#define freespace_MapEdges_h

#include "Common/DisparityMap.h"

#include <algorithm>
#include <array>

namespace freespace
{

/// Whether a triangle of the map has both points.
inline bool HasEdge(const DisparityMap& map, int a, int b)
{
  return std::any_of(map.triangles.begin(), map.triangles.end(),
    [a, b](const std::array<int, 3>& t)
    { return std::count(t.begin(), t.end(), a) && std::count(t.begin(), t.end(), b); });
}

}

#endif
