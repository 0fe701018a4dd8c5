// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_LookAt_h
#define freespace_LookAt_h

#include "Common/Camera.h"

namespace freespace
{

/// The camera at `center`, turned to `middle`, upright, with the intrinsics of another one. `up` must
/// not be parallel to the line of sight.
Camera LookAt(const Camera& like, const Eigen::Vector3d& center, const Eigen::Vector3d& middle,
  const Eigen::Vector3d& up);

}

#endif
