// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_PlaceAround_h
#define freespace_PlaceAround_h

#include "Viewpoints/LookAt.h"

#include <cmath>

namespace freespace
{

/// A camera at a distance from a point that it looks at, with z upwards; angles in radians.
inline Camera PlaceAround(
  double azimuth, double elevation, double distance, const Eigen::Vector3d& middle)
{
  Camera like;
  like.K << 800, 0, 320, 0, 800, 240, 0, 0, 1;
  like.width = 640;
  like.height = 480;
  const Eigen::Vector3d from(std::cos(azimuth) * std::cos(elevation),
    std::sin(azimuth) * std::cos(elevation), std::sin(elevation));
  return LookAt(like, middle + distance * from, middle, Eigen::Vector3d::UnitZ());
}

}

#endif
