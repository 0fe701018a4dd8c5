// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Outliers_h
#define freespace_Outliers_h

#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Common/View.h"
#include "Disparity/DelaunayDisparity.h"
#include "Disparity/Outliers/OutlierOptions.h"

#include <vector>

namespace freespace
{

/// For each view and each of its features whether it passes the tests for outliers: first that of its support, then
/// those against the other views' free space and against their features. Without a radius, and where other views
/// are asked, features in no triangle of the view's own triangulation (of which `triangulation` tells whether edges
/// constrain it) are outliers; with a radius, those that are not finite or not in front of the camera. A view of
/// which fewer than three features would pass keeps all.
///
/// Throws Error when an option is out of its range, and as TriangulateViews does where views are triangulated.
std::vector<std::vector<char>> AcceptedFeatures(const std::vector<View>& views,
  const OutlierOptions& options, const DelaunayDisparityOptions& triangulation = {},
  const ParallelFor& parallelFor = SerialFor, const Progress& progress = Progress());

/// The views with their accepted features only.
std::vector<View> RejectOutliers(const std::vector<View>& views, const OutlierOptions& options,
  const DelaunayDisparityOptions& triangulation = {}, const ParallelFor& parallelFor = SerialFor,
  const Progress& progress = Progress());

}

#endif
