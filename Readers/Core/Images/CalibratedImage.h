// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_CalibratedImage_h
#define freespace_CalibratedImage_h

#include "Common/Camera.h"

#include <string>
#include <vector>

namespace freespace
{

/// How the lens shows a point at (x / z, y / z), r from the optical axis.
enum class LensKind
{
  Perspective,      ///< OpenCV's distortion: k1 k2 p1 p2 [k3 [k4 k5 k6]]
  Fisheye,          ///< OpenCV's fisheye, of the angle atan(r): k1 k2 k3 k4
  ThinPrismFisheye, ///< COLMAP's, of the angle: k1 k2 p1 p2 k3 k4 sx1 sy1
  FieldOfView       ///< atan(2 r tan(w / 2)) / w: w
};

/// An image with the camera that took it. The lens distortion is kept separate from the pinhole
/// camera, because the stages after the undistortion use the pinhole only.
struct CalibratedImage
{
  std::string file; ///< relative to the scene's `images`
  Camera camera;
  LensKind lens = LensKind::Perspective;
  /// As listed at LensKind; empty for a perspective lens without distortion. The normalized
  /// coordinates (x / z, y / z) are distorted, so that the pixel convention of K does not matter.
  std::vector<double> distortion;

  /// Whether the image has no lens distortion.
  bool IsPinhole() const { return this->lens == LensKind::Perspective && this->distortion.empty(); }
};

}

#endif
