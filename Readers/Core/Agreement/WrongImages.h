// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_WrongImages_h
#define freespace_WrongImages_h

#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Matching/MatcherOptions.h"
#include "Refinement/EdgeTracks.h"
#include "Refinement/NeighborMatching.h"
#include "Scene/Scene.h"
#include "Stereo/EdgeStore.h"

#include <cstddef>
#include <string>
#include <vector>

namespace freespace
{

/// How images that do not fit their cameras are looked for.
struct WrongImageOptions
{
  NeighborMatchingOptions matching;
  int rounds = 3; ///< at most: without the wrong ones the others have better neighbours; > 0

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// The images of a scene that contradict the others (FindAgreement), by name, in the model's
/// order: images that are upside down or under another's name, and wrong cameras. The edges of each
/// image are matched with those of its neighbours. The same result for any number of threads.
///
/// tracks: those of the clusters that were matched, `TracksOfEach` of each, for RefineCameras, which matches
/// the same clusters in the same way at first; the images' indices are those of this model. Null: not wanted.
///
/// Throws Error as MatchCluster does, and Aborted when the progress says so.
std::vector<std::string> FindWrongImages(const Scene& scene, const SparseModel& model,
  EdgeStore& edges, const MatcherOptions& matching, const WrongImageOptions& options,
  const ParallelFor& parallelFor, const Progress& progress, ClusterTracks* tracks = nullptr);

}

#endif
