// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_CommonUp_h
#define freespace_CommonUp_h

#include "Common/Camera.h"

#include <vector>

namespace freespace
{

/// The up direction of the world, a unit vector: the maximum likelihood estimate from the rolls of the
/// cameras. Most people hold a camera upright to within some degrees, some on its side, few in other ways, and
/// the roll of a camera that looks along up is undetermined. Where the up vectors of the images agree the
/// result is their mean; it also works for a ring of cameras that look down steeply, or if some were held on
/// their side. If all cameras have the same orientation, up is perpendicular to the line of sight. Zero without
/// cameras.
Eigen::Vector3d CommonUp(const std::vector<Camera>& cameras);

}

#endif
