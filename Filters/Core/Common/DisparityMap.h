// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_DisparityMap_h
#define freespace_DisparityMap_h

#include "Common/View.h"

namespace freespace
{

/// A view whose features are triangulated in the image. Between them disparity (1 / depth) is linear
/// in the pixel, which makes each image triangle the image of one space triangle.
struct DisparityMap : View
{
  std::vector<int> sourceView;               ///< per point: index of the view that supplied it;
                                             ///< -1: no feature, but the background behind an edge
  std::vector<std::array<int, 3>> triangles; ///< counter-clockwise in pixel coordinates (y down)
};

}

#endif
