// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_CalibratedImage_h
#define freespace_CalibratedImage_h

#include "Common/Camera.h"

#include <string>
#include <vector>

namespace freespace
{

/// A photograph with the camera that took it. The lens's distortion stands beside the pinhole
/// camera: the stages after the undistortion know the pinhole only.
struct CalibratedImage
{
  std::string file; ///< relative to the scene's `images`
  Camera camera;
  /// In OpenCV's order: k1 k2 p1 p2 [k3 [k4 k5 k6]]; empty without distortion. The normalized
  /// coordinates (x / z, y / z) are distorted, so that the pixel convention of K does not matter.
  std::vector<double> distortion;
};

}

#endif
