// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_TriangulationSupport_h
#define freespace_TriangulationSupport_h

#include "Common/CancellationFlag.h"
#include "Common/DisparityMap.h"
#include "Disparity/Outliers/OutlierOptions.h"

#include <vector>

namespace freespace
{

/// Thresholds in units of OutlierOptions::noise: features that differ by less agree.
constexpr double Agreement = 4;

/// Per point of a view's own map whether enough of its nearest neighbours in the triangulation have a similar
/// disparity. The threshold depends on the view: where features are sparse, disparities differ more from one to
/// the next.
std::vector<char> SupportedPoints(
  const DisparityMap& map, const OutlierOptions& options, const CancellationFlag& stop);

}

#endif
