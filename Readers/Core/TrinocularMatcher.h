// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_TrinocularMatcher_h
#define freespace_TrinocularMatcher_h

#include "Camera.h"
#include "EdgeTokens.h"

#include <limits>
#include <vector>

namespace freespace
{

/// When edges of several images are taken for images of one edge in space.
struct MatcherOptions
{
  double minimumDisparity = 0; ///< 1 / depth in the reference camera, 1 / unit of length; >= 0
  double maximumDisparity = std::numeric_limits<double>::infinity(); ///< > minimumDisparity
  double tolerance = 0.7;     ///< of a third image's confirmation, pixels across the edge; > 0
  double minimumAngle = 6;    ///< between an edge and the epipolar line, degrees; edges nearer to
                              ///< parallel are left to another triplet; (0, 90)
  double angleTolerance = 35; ///< between the directions of matching edges, degrees; (0, 90)
  double colorTolerance = 45; ///< mean difference on the better side of the edge, grey levels; > 0
  double maximumCost = 0.4;   ///< of a match, in [0, 1], see EdgeMatch
  double gradientLimit = 0.5; ///< change of disparity (pixels of the longest baseline) for each
                              ///< pixel along a chain that counts as continuous; > 0
  int minimumRun = 4;         ///< tokens of a chain that are matched without a break; > 0

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// The edges of one calibrated image.
struct ImageEdges
{
  Camera camera;
  EdgeChains edges;
};

/// What became of a token of the reference image.
struct EdgeMatch
{
  int images = 0;       ///< besides the reference that show it: 0 when it has no match, 1 where it
                        ///< closes a short gap between confirmed ones, else >= 2
  int run = -1;         ///< number of the unbroken piece of chain that it belongs to
  double disparity = 0; ///< 1 / depth in the reference camera, from all rays together
  Eigen::Vector2d imagePoint = Eigen::Vector2d::Zero(); ///< where the reference sees it: the token,
    ///< moved across the edge by the little that lets all rays meet best
  double cost = 0; ///< mean over the images, in [0, 1]: colours, direction and distance
};

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
