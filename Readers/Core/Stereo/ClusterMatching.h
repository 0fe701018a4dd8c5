// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ClusterMatching_h
#define freespace_ClusterMatching_h

#include "Common/CancellationFlag.h"
#include "Matching/TrinocularMatcher.h"
#include "Scene/Scene.h"
#include "Stereo/EdgeStore.h"

#include <vector>

namespace freespace
{

/// The edges of a cluster's images and their matches.
struct ClusterMatches
{
  int referenceImage = 0;       ///< index of the image
  std::vector<int> otherImages; ///< and of those beside it
  ImageEdges reference;
  std::vector<ImageEdges> others;
  LargeVector<EdgeMatch> matches;     ///< one for each token of the reference
  LargeVector<EdgeCandidate> support; ///< tokens of the others, see EdgeMatch
};

/// Matches the edges of a cluster's images over all its triplets together. An infinite greatest
/// disparity is replaced by the greatest that the cameras of a triplet see in common.
///
/// Pieces of the reference's chains with about `mostTokens` tokens in all, evenly chosen, are matched.
///
/// Throws Error naming the file or cluster: an image that is missing, unreadable or of another size
/// than its camera's, an unknown image, a triplet without overlap. Throws Aborted when the flag is
/// set, at the next image.
ClusterMatches MatchCluster(EdgeStore& edges, const std::vector<CalibratedImage>& images,
  const Cluster& cluster, const MatcherOptions& options, std::size_t mostTokens,
  const CancellationFlag& stop);

}

#endif
