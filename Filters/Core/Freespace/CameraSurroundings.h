// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_CameraSurroundings_h
#define freespace_CameraSurroundings_h

#include "Common/DisparityMap.h"
#include "Freespace/RegionHull.h"

namespace freespace
{

/// For each camera inside the hull six maps, which together see all around it, of a cube whose half side is the
/// share of the distance to the nearest features (but for the nearest thousandth of them). Where a camera was is
/// free, and so is what is nearer to it than anything that was seen; without it, a camera between things looks at
/// the matter that its own image's border leaves beside it. The maps have the `imageFile` of no image, and
/// each names in `sourceView` of its points the camera's view.
std::vector<DisparityMap> CameraSurroundings(
  const std::vector<ViewFeatures>& views, const RegionHull& region, double share);

}

#endif
