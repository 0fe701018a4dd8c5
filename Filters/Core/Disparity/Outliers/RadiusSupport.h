// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_RadiusSupport_h
#define freespace_RadiusSupport_h

#include "Common/View.h"

#include <vector>

namespace freespace
{

/// The mean distance between the features of a view in the image, if they were spread evenly over the box that holds
/// them, pixels; 0 without usable ones.
double MeanSpacing(const View& view);

/// For each feature, how many others within the radius (pixels, > 0) agree with its disparity: they differ by no more
/// than the tolerance, a fraction of the greater one. Features that are not finite or not in front of the camera give
/// no support and count -1. Counts above a thousand may be too low: features that lie upon each other by the million
/// take no longer than others. O(n log n).
std::vector<int> CountSupport(const View& view, double radius, double tolerance);

}

#endif
