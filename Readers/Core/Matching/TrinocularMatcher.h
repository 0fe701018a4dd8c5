// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_TrinocularMatcher_h
#define freespace_TrinocularMatcher_h

#include "Edges/LargeVector.h"
#include "Matching/EdgeMatch.h"
#include "Matching/MatcherOptions.h"

#include <vector>

namespace freespace
{

/// Matches the tokens of a reference image over two or more other images: section 3's "feature
/// based stereo".
///
/// Each token's epipolar line in another image is cut with that image's linked chains, which gives
/// candidates with a sub-pixel disparity; edges of another direction or with other colours on both
/// sides are not among them, nor are those that no other image's edge can confirm. A match goes on
/// along an edge, so only every few tokens search their whole epipolar lines, and these only where no
/// good match leads to them; the others follow what these found along the other images' chains. The
/// better side of an edge decides, so that a silhouette is
/// recognized by the object, whatever lies behind it. Candidates of two images that agree to within
/// the tolerance, by the true geometry of both pairs, confirm each other and make a hypothesis. One
/// hypothesis per token is chosen along the chain by dynamic programming, and a token of another
/// image serves one edge of the reference only. The disparity is that of the point which is nearest
/// to the edge lines in all images, in pixels.
///
/// Returns one match per token. Needs two others at least.
LargeVector<EdgeMatch> MatchEdges(const ImageEdges& reference,
  const std::vector<ImageEdges>& others, const MatcherOptions& options);

}

#endif
