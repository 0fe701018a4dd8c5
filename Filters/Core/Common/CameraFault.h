// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_CameraFault_h
#define freespace_CameraFault_h

#include "Common/Camera.h"

#include <string>

namespace freespace
{

/// What is wrong with a camera, as the end of a sentence that begins with whose camera it is; empty: nothing. The
/// intrinsics are upper triangular with positive focal lengths and a last row of 0 0 1, the pose begins with a rotation
/// (to 1e-4, as numbers of a text file are), and the image has pixels.
inline std::string CameraFault(const Camera& camera)
{
  const Eigen::Matrix3d& K = camera.K;
  if (!K.allFinite() || !camera.R.allFinite() || !camera.t.allFinite())
  {
    return "has a camera that is not finite";
  }
  if (K(1, 0) != 0 || K.row(2) != Eigen::RowVector3d(0, 0, 1))
  {
    return "has intrinsics that are not upper triangular with a last row of 0 0 1";
  }
  if (!(K(0, 0) > 0 && K(1, 1) > 0))
  {
    return "has a focal length that is not positive";
  }
  if (!camera.R.isUnitary(1e-4) || camera.R.determinant() < 0)
  {
    return "has a pose that does not begin with a rotation";
  }
  if (camera.width <= 0 || camera.height <= 0)
  {
    return "has an image without pixels";
  }
  return "";
}

}

#endif
