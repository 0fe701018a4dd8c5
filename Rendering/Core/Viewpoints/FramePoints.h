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
  MayBeCutOff ///< points far beyond most others may lie beyond the border of the picture
};

/// A camera translated, not rotated, to the nearest position from which its image shows all points, centred,
/// with a margin of 2 % on each side. Points that are not finite are ignored; without any the camera is unchanged.
Camera FramePoints(const Camera& camera, const std::vector<Eigen::Vector3d>& points,
  Outliers outliers = Outliers::InFrame);

/// The factor by which the distance of a camera from the middle, at which it looks, has to grow for its picture to
/// show the points; those far beyond most others may be cut off. 1 without finite points.
double FarEnough(
  const Camera& camera, const Eigen::Vector3d& middle, const std::vector<Eigen::Vector3d>& points);

/// The camera with a picture of another size, which shows all that the picture of the given camera shows.
Camera WithSize(const Camera& camera, int width, int height);

}

#endif
