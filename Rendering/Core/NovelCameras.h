// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_NovelCameras_h
#define freespace_NovelCameras_h

#include "Camera.h"

#include <vector>

namespace freespace
{

/// Viewpoints that no camera has but from which much was seen: each is halfway between two neighbouring
/// cameras, going round `middle`, at which it looks. The first lies beside the first camera, each further
/// one as far as may be from those before.
///
/// Neighbours are at least 10 and at most 120 degrees apart as seen from the middle; a camera without one is
/// gone round by 15 degrees instead. At most `count` cameras are returned, fewer where there are fewer places,
/// none without cameras. Intrinsics are those of the first camera.
std::vector<Camera> NovelCameras(
  const std::vector<Camera>& cameras, const Eigen::Vector3d& middle, int count);

/// The middle of points, by the median of each coordinate, which a few that are far off do not move.
/// Zero without points.
Eigen::Vector3d MedianPoint(const std::vector<Eigen::Vector3d>& points);

}

#endif
