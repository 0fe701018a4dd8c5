// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_DisparityMaps_h
#define freespace_DisparityMaps_h

#include "Common/DisparityMap.h"
#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Common/View.h"
#include "Disparity/Background/BackgroundContinuation.h"
#include "Disparity/DelaunayDisparity.h"
#include "Disparity/FeatureThinning.h"
#include "Disparity/Outliers/OutlierOptions.h"
#include "Disparity/TrimTriangles.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace freespace
{

/// The steps from features to disparity maps, in their order.
struct DisparityMapOptions
{
  FeatureThinningOptions thinning;
  OutlierOptions outliers;
  DelaunayDisparityOptions disparity;
  bool continueBackground = true; ///< off in the paper
  BackgroundOptions background;
  TrimOptions trim;

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// Makes the disparity maps of views: ThinFeatures, RejectOutliers, TriangulateViews, ContinueBackground and
/// TrimTriangles. Each finished map is handed over with the index of its view, by several threads at a time, so that
/// not all maps need to be in memory twice.
///
/// Throws Error when an option is out of its range or a view has fewer than three features in general position.
/// Throws Aborted when the progress says so.
void MakeDisparityMaps(std::vector<View> views, const DisparityMapOptions& options,
  const ParallelFor& parallelFor, const Progress& progress,
  const std::function<void(std::size_t, DisparityMap)>& take);

}

#endif
