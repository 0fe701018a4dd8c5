// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_NearestOnTriangle_h
#define freespace_NearestOnTriangle_h

#include <Eigen/Geometry>

namespace freespace
{

/// The weights of the point of a triangle that is nearest to a point. A triangle without area is its edges.
Eigen::Vector3d NearestOnTriangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
  const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}

#endif
