// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_EdgeMatch_h
#define freespace_EdgeMatch_h

#include "Common/Camera.h"
#include "Edges/EdgeTokens.h"

namespace freespace
{

/// The edges of one calibrated image.
struct ImageEdges
{
  Camera camera;
  EdgeChains edges;
};

/// The match of a token of the reference image.
struct EdgeMatch
{
  int images = 0;       ///< besides the reference that show it: 0 when it has no match, 1 where it
                        ///< closes a short gap between confirmed ones, else >= 2
  int support = 0;      ///< where these begin in the list of all matches' support
  int run = -1;         ///< number of the unbroken piece of chain that it belongs to
  double disparity = 0; ///< 1 / depth in the reference camera, from all rays together
  Eigen::Vector2d imagePoint = Eigen::Vector2d::Zero(); ///< where the reference sees it: the token,
    ///< moved across the edge by the little that lets all rays meet best
  double deviation = 0; ///< standard deviation of the disparity
  double cost = 0;      ///< mean over the images, in [0, 1]: colours, direction and distance
};

}

#endif
