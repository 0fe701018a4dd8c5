// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Turntable_h
#define freespace_Turntable_h

#include "Camera.h"

#include <vector>

namespace freespace
{

/// Cameras at equal angles around what the given ones look at, beginning near the first of them.
///
/// The middle is the point nearest to all optical axes, up is the mean of the cameras' own, height and
/// distance from the axis are the means of theirs, and the intrinsics are those of the first. Throws
/// Error when there is no camera, when they all look the same way (then there is no middle), or when
/// up is not to be told.
std::vector<Camera> TurntableCameras(const std::vector<Camera>& cameras, int count);

}

#endif
