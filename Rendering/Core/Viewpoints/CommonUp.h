// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_CommonUp_h
#define freespace_CommonUp_h

#include "Common/Camera.h"

#include <vector>

namespace freespace
{

/// Where cameras have up in the world, of length 1: the direction from which it is likeliest that people
/// held the cameras as they did. Most hold a camera upright to within some degrees, some on its side,
/// few upside down or anyhow, and the more a camera looks along up the less its roll tells. What is the
/// mean of the images' up where these agree is found as well for a ring of cameras that look down
/// steeply, or where some were held on their side. Cameras that are all turned alike say where up is in their
/// images only: then it is across the lines of sight. Zero without cameras.
Eigen::Vector3d CommonUp(const std::vector<Camera>& cameras);

}

#endif
