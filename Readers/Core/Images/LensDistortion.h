// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_LensDistortion_h
#define freespace_LensDistortion_h

#include "Images/CalibratedImage.h"

#include <vector>

namespace freespace
{

/// The greatest angle between an optical axis and a ray that is made a pixel of a pinhole camera, degrees.
/// A fisheye lens sees further, where a pinhole camera's pixels go to infinity.
constexpr double largestPinholeAngle = 80;

/// The pixels that the pinhole camera sees where the lens with its distortion shows the given ones. Not a
/// number where a fisheye lens looks beyond `largestPinholeAngle`, or shows nothing.
std::vector<Eigen::Vector2d> UndistortPixels(
  const CalibratedImage& image, const std::vector<Eigen::Vector2d>& pixels);

/// Where the lens shows what the pinhole camera sees in the given pixels: the inverse of UndistortPixels.
std::vector<Eigen::Vector2d> DistortPixels(
  const CalibratedImage& image, const std::vector<Eigen::Vector2d>& pixels);

}

#endif
