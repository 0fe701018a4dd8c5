// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_OverlappingViews_h
#define freespace_OverlappingViews_h

#include "Common/DisparityMap.h"

#include <vector>

namespace freespace
{

/// For each map the other maps, in ascending order, that can say something about what it sees: the box
/// of the one's free space and of the surface behind it meets the box of all that the other could look
/// at, down to its deepest feature. In n log n and the number of pairs: views of a landscape meet few
/// others, however many there are.
std::vector<std::vector<int>> OverlappingViews(const std::vector<DisparityMap>& maps);

}

#endif
