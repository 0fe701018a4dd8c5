// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_TrinocularMatcher_h
#define freespace_TrinocularMatcher_h

#include "Edges/LargeVector.h"
#include "Matching/EdgeHypothesis.h"
#include "Matching/EdgeMatch.h"
#include "Matching/MatcherOptions.h"

#include <vector>

namespace freespace
{

/// Matches the tokens of a reference image over two or more other images: the feature based stereo of
/// section 3.
///
/// 1. CandidateSearch intersects the epipolar line of a token in another image with the linked chains of
///    that image, which gives candidates with a sub-pixel disparity. Edges of another direction, with
///    other colours on both sides, or that no edge of a third image can confirm are rejected. A match
///    continues along an edge, so only every few tokens search their whole epipolar lines, and these
///    only where no good match leads to them; the others follow their neighbours' candidates along the
///    chains of the other images. The better side of an edge decides, so that a silhouette is recognized
///    by the object, whatever its background.
/// 2. HypothesisBuilder makes a hypothesis of candidates of two images that agree within the tolerance,
///    by the exact geometry of both pairs: they confirm each other.
/// 3. ChainOptimizer chooses one hypothesis per token along the chain by dynamic programming.
/// 4. A token of another image serves only one edge of the reference. RunFitting fits the disparity of
///    the point nearest to the edge lines in all images, in pixels; RunFilter rejects short runs
///    without support.
///
/// Returns one match per token, and through `support` the tokens of the other images (by their numbers)
/// that it rests upon. Needs two others at least.
LargeVector<EdgeMatch> MatchEdges(const ImageEdges& reference,
  const std::vector<ImageEdges>& others, const MatcherOptions& options,
  LargeVector<EdgeCandidate>* support = nullptr);

}

#endif
