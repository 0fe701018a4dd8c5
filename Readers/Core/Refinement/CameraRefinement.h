// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_CameraRefinement_h
#define freespace_CameraRefinement_h

#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Matching/MatcherOptions.h"
#include "Refinement/BundleAdjustment.h"
#include "Refinement/NeighborMatching.h"
#include "Scene/Scene.h"
#include "Stereo/EdgeStore.h"

#include <cstddef>
#include <string>
#include <vector>

namespace freespace
{

/// How the cameras of a scene are refined by the edges of its images.
struct CameraRefinementOptions
{
  BundleAdjustmentOptions adjustment;
  NeighborMatchingOptions matching; ///< half of its tolerance in each round after the first
  int rounds = 2;                   ///< of matching and adjusting; > 0
  double leastMotion =
    0.12; ///< median motion of the images, pixels, for the cameras to be changed at
          ///< all: the noise of the edges alone moves them by 0.05 to 0.1; >= 0

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// The result of the refinement.
struct CameraRefinement
{
  std::vector<CalibratedImage> images; ///< as given or refined, in the given order
  bool isRefined = false;            ///< false: the given cameras are as good as the edges can tell
  std::size_t clusters = 0;          ///< images around which edges were matched
  std::size_t tracks = 0;            ///< of the last adjustment
  BundleAdjustmentSummary residuals; ///< of the first adjustment before, of the last one after, on
                                     ///< the first's and last's tracks
};

/// Refines the poses of the images (and the focal lengths where asked): the edges of each are matched
/// with those of its neighbours, loosely at first, and the cameras are adjusted to them
/// (AdjustCameras); then more strictly, with the adjusted cameras. Images that no cluster holds stay as
/// they are. The same result for any number of threads.
///
/// Noise alone moves exact cameras: cameras that the edges move by no more than that are not
/// changed at all.
///
/// known: tracks of some clusters that were matched with the given cameras, with the same options
/// (FindWrongImages): they are not matched again.
///
/// `images` and `model` as ReadSceneModel gives them. Throws Error naming the file: an image that is
/// missing, unreadable or of another size than its camera's. Throws Aborted.
CameraRefinement RefineCameras(const Scene& scene, const SparseModel& model, EdgeStore& edges,
  const MatcherOptions& matching, const CameraRefinementOptions& options,
  const ParallelFor& parallelFor, const Progress& progress, const ClusterTracks& known = {});

/// The model with the poses and focal lengths of these images, which are its own in its order.
SparseModel WithCameras(SparseModel model, const std::vector<CalibratedImage>& images);

}

#endif
