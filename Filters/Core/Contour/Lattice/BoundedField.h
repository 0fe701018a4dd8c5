// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BoundedField_h
#define freespace_BoundedField_h

#include "Contour/Lattice/ContourField.h"

namespace freespace
{

/// A field restricted to a box; everything outside is free.
class BoundedField
{
public:
  BoundedField(const ContourField& field, const Eigen::AlignedBox3d& bounds)
    : Field(field)
    , Bounds(bounds)
  {
  }

  bool IsFree(const Eigen::Vector3d& point, const FieldScope& scope) const
  {
    return !this->Bounds.contains(point) || this->Field.IsFree(point, scope);
  }

  BoxContent Classify(
    const Eigen::AlignedBox3d& box, const FieldScope& parent, FieldScope& scope) const;

  bool Crossing(const Eigen::Vector3d& matter, const Eigen::Vector3d& free, const FieldScope& scope,
    double& place, SurfaceLabel& label) const;

  SurfaceLabel Label(
    const Eigen::Vector3d& free, const Eigen::Vector3d& matter, const FieldScope& scope) const;

  FieldScope Root() const { return this->Field.Root(); }
  const ContourField& Inner() const { return this->Field; }
  const Eigen::AlignedBox3d& Box() const { return this->Bounds; }

private:
  const ContourField& Field;
  const Eigen::AlignedBox3d Bounds;
};

}

#endif
