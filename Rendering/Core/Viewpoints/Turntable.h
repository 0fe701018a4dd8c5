// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Turntable_h
#define freespace_Turntable_h

#include "Common/Camera.h"

#include <vector>

namespace freespace
{

/// Cameras at equal angles around the point that the given cameras look at, starting near the first.
///
/// The middle is the point nearest to all optical axes, up is that of CommonUp.h, height and
/// distance from the axis are the means of theirs, and the intrinsics are those of the first. With points, the
/// cameras keep their directions, at the distance at which all their pictures show the points but for distant ones. Throws
/// Error when there is no camera, or when they all look the same way (then there is no middle).
std::vector<Camera> TurntableCameras(
  const std::vector<Camera>& cameras, int count, const std::vector<Eigen::Vector3d>& points = {});

}

#endif
