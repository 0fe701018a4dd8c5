// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Boxes_h
#define freespace_Boxes_h

#include <vtkMath.h>

#include <Eigen/Geometry>

namespace freespace
{

/// VTK's bounds (x0, x1, y0, y1, z0, z1) as a box; uninitialized ones are an empty box.
inline Eigen::AlignedBox3d BoxOf(const double bounds[6])
{
  return Eigen::AlignedBox3d(Eigen::Vector3d(bounds[0], bounds[2], bounds[4]),
    Eigen::Vector3d(bounds[1], bounds[3], bounds[5]));
}

/// The bounds of a box; uninitialized (1, -1, ...) for an empty one.
inline void GiveBounds(const Eigen::AlignedBox3d& box, double bounds[6])
{
  vtkMath::UninitializeBounds(bounds);
  for (int axis = 0; axis < 3 && !box.isEmpty(); ++axis)
  {
    bounds[2 * axis] = box.min()[axis];
    bounds[2 * axis + 1] = box.max()[axis];
  }
}

}

#endif
