// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Octant_h
#define freespace_Octant_h

#include <Eigen/Geometry>

namespace freespace
{

/// One of the eight octants of a box, in [0, 8): bit a of the octant is set for the upper
/// half along axis a.
inline Eigen::AlignedBox3d Octant(const Eigen::AlignedBox3d& box, int octant)
{
  const Eigen::Vector3d middle = box.center();
  Eigen::AlignedBox3d part;
  for (int axis = 0; axis < 3; ++axis)
  {
    const bool isUpper = octant >> axis & 1;
    part.min()[axis] = isUpper ? middle[axis] : box.min()[axis];
    part.max()[axis] = isUpper ? box.max()[axis] : middle[axis];
  }
  return part;
}

/// The octant of a box that contains a point of the box. The lower one where the point is between
/// two.
inline int OctantOf(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& point)
{
  const Eigen::Vector3d middle = box.center();
  int octant = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    octant |= (point[axis] > middle[axis] ? 1 : 0) << axis;
  }
  return octant;
}

}

#endif
