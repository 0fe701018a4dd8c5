// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_FramePoints_h
#define freespace_FramePoints_h

#include "Common/Camera.h"

#include <vector>

namespace freespace
{

enum class Outliers
{
  InFrame,
  NotHeeded ///< what lies far beyond the most of the points may be cut off by the picture's border
};

/// A camera translated, not rotated, to the nearest position from which its image shows all points, centred,
/// with a margin of 2 % on each side. Points that are not finite are ignored; without any the camera is unchanged.
Camera FramePoints(const Camera& camera, const std::vector<Eigen::Vector3d>& points,
  Outliers outliers = Outliers::InFrame);

/// How many times as far as it is from the middle, at which it looks, a camera has to be for its picture to hold
/// the points; those that lie far beyond the most of them may be cut off. 1 without finite points.
double FarEnough(
  const Camera& camera, const Eigen::Vector3d& middle, const std::vector<Eigen::Vector3d>& points);

/// The camera with a picture of another size that holds all that the camera's own holds.
Camera WithSize(const Camera& camera, int width, int height);

}

#endif
