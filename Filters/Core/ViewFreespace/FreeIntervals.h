// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_FreeIntervals_h
#define freespace_FreeIntervals_h

#include "ViewFreespace/DisparityRaster.h"

#include <functional>
#include <utility>
#include <vector>

namespace freespace
{

/// Ranges of [0, 1], in ascending order and disjoint.
using Intervals = std::vector<std::pair<double, double>>;

/// Returns false to stop.
using IntervalVisitor = std::function<bool(double begin, double end)>;

/// The parts of a segment in front of a disparity map, as ranges of [0, 1] from its first point to
/// its last, one by one in ascending order until the visitor returns false. Exact: along a segment
/// all is linear within a triangle, and adjacent triangles meet at exactly the same place. Time in
/// proportion to the segment's length in the image.
void VisitFreeIntervals(const DisparityRaster& raster, const Eigen::Vector3d& first,
  const Eigen::Vector3d& last, const IntervalVisitor& visit);

}

#endif
