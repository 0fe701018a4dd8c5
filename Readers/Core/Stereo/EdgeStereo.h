// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_EdgeStereo_h
#define freespace_EdgeStereo_h

#include "Common/CancellationFlag.h"
#include "Common/Error.h"
#include "Common/View.h"
#include "Edges/EdgeTokens.h"
#include "Matching/TrinocularMatcher.h"
#include "Patches/PatchOptions.h"
#include "Patches/ImagePyramids.h"
#include "Scene/Scene.h"
#include "Stereo/EdgeStore.h"

namespace freespace
{

/// A cluster has fewer than three features, too few for a disparity map.
class TooFewFeatures : public Error
{
public:
  using Error::Error;
};

/// Options of the feature detection of a cluster.
struct EdgeStereoOptions
{
  EdgeTokenOptions edges;
  MatcherOptions matching; ///< an infinite maximumDisparity is replaced by the greatest that the
                           ///< cameras of a triplet see in common
  PatchOptions patches;    ///< features beside those of edges

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// The features of a cluster in its reference image, section 3 of the paper: the edges of its
/// images, matched over all its triplets together, so that edges of every orientation are found and
/// each feature is seen in three images at least. Every feature lies on the ray of its image point.
/// Edge positions are freed of the lens's distortion, images are not resampled: the view's camera
/// is the pinhole of the reference.
///
/// Beyond the paper, patches become features where the edges leave gaps, see FindPatches. They follow
/// the edges', are in no chain (-1) and have no direction (0).
///
/// `images` is what ReadSceneImages returned, or has refined cameras.
/// Throws Error naming the file or cluster: an image that is missing, unreadable or of another size
/// than its camera's, an unknown image, a triplet without overlap; TooFewFeatures.
/// Throws Aborted when the flag is set, at the next image.
EdgeView FindFeatures(EdgeStore& edges, ImagePyramids& photographs,
  const std::vector<CalibratedImage>& images, const Cluster& cluster,
  const EdgeStereoOptions& options, const CancellationFlag& stop = NeverCancelled);

/// The same for a single cluster, whose images are loaded from the scene's folder.
EdgeView FindFeatures(const Scene& scene, const std::vector<CalibratedImage>& images,
  const Cluster& cluster, const EdgeStereoOptions& options,
  const CancellationFlag& stop = NeverCancelled);

}

#endif
