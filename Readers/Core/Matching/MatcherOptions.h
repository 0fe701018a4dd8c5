// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_MatcherOptions_h
#define freespace_MatcherOptions_h

#include <limits>

namespace freespace
{

/// Criteria for edges of several images to be images of one edge in space.
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
  double gradientLimit = 0.5; ///< change of disparity (pixels of the shortest baseline) for each
    ///< pixel along a chain that counts as continuous; > 0. A slanted surface
    ///< stays as steep when an image farther off is matched, too
  int minimumRun = 4; ///< tokens of a chain that are matched without a break; > 0

  /// Throws Error when a field is out of its range.
  void Check() const;
};

}

#endif
