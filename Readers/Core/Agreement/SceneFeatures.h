// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SceneFeatures_h
#define freespace_SceneFeatures_h

#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Stereo/EdgeStereo.h"

#include <cstddef>
#include <string>
#include <vector>

namespace freespace
{

/// The clusters with so few features for their edges that something must be wrong: fewer than three,
/// or, where several others give a typical share, less than a fifteenth of the median share of edge tokens
/// that become features. Matches by chance alone give a fiftieth. Per view, as given.
std::vector<char> FindPoorViews(const std::vector<EdgeView>& views);

/// FindFeatures for all clusters of a scene; poor views are left out. Each of these that belongs to the
/// first `needed` clusters is named in a warning. Other views of fewer than three features are dropped without
/// a warning.
///
/// As many clusters at a time as there are threads: this bounds the memory. Throws Error as FindFeatures
/// does for the first cluster of the needed that fails, TooFewFeatures only when no view is left.
std::vector<EdgeView> FindSceneFeatures(const Scene& scene,
  const std::vector<CalibratedImage>& images, EdgeStore& edges, std::size_t needed,
  const EdgeStereoOptions& options, const ParallelFor& parallelFor, const Progress& progress,
  std::vector<std::string>& warnings);

}

#endif
