// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/Lattice/BoundedField.h"

#include <algorithm>

namespace freespace
{

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

BoxContent BoundedField::Classify(
  const AlignedBox3d& box, const FieldScope& parent, FieldScope& scope) const
{
  if (!this->Bounds.intersects(box))
  {
    return BoxContent::Free;
  }
  const BoxContent content = this->Field.Classify(box, parent, scope);
  return content == BoxContent::Matter && !this->Bounds.contains(box) ? BoxContent::Mixed : content;
}

bool BoundedField::Crossing(const Vector3d& matter, const Vector3d& free, const FieldScope& scope,
  double& place, SurfaceLabel& label) const
{
  if (this->Bounds.contains(free))
  {
    return this->Field.Crossing(matter, free, scope, place, label);
  }
  // At the bounds, unless the field has a crossing before.
  double exit = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double step = free[axis] - matter[axis];
    const double side = step > 0 ? this->Bounds.max()[axis] : this->Bounds.min()[axis];
    exit = step == 0.0 ? exit : std::min(exit, (side - matter[axis]) / step);
  }
  const Vector3d border = matter + exit * (free - matter);
  if (this->Field.IsFree(border, scope))
  {
    const bool isKnown = this->Field.Crossing(matter, border, scope, place, label);
    place *= exit;
    return isKnown;
  }
  place = exit;
  label = { -1, SurfaceKind::Hull, (free - matter).normalized() };
  return true;
}

SurfaceLabel BoundedField::Label(
  const Vector3d& free, const Vector3d& matter, const FieldScope& scope) const
{
  if (this->Bounds.contains(free))
  {
    return this->Field.Label(free, matter, scope);
  }
  SurfaceLabel label;
  label.normal = (free - matter).normalized();
  return label;
}

}
