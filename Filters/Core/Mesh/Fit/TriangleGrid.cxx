// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Fit/TriangleGrid.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

Vector3d LowOf(const std::vector<Vector3d>& points)
{
  Eigen::AlignedBox3d box;
  for (const Vector3d& point : points)
  {
    box.extend(point);
  }
  return box.isEmpty() ? Vector3d::Zero() : Vector3d(box.min());
}

}

TriangleGrid::TriangleGrid(
  const std::vector<Vector3d>& points, const Triangles& triangles, double cell)
  : Points(points)
  , Corners(triangles)
  , Side(cell)
  , Grid(triangles.size(), LowOf(points), cell,
      [&](std::size_t t)
      {
        Eigen::AlignedBox3d box;
        for (const int corner : triangles[t])
        {
          box.extend(points[corner]);
        }
        return box;
      })
{
  this->FindBounds();
}

void TriangleGrid::FindBounds()
{
  this->Around.reserve(this->Corners.size());
  for (const auto& [i, j, k] : this->Corners)
  {
    const Vector3d &a = this->Points[i], &b = this->Points[j], &c = this->Points[k];
    const Vector3d center = (a + b + c) / 3, normal = (b - a).cross(c - a);
    const double radius = std::sqrt(std::max(
      { (a - center).squaredNorm(), (b - center).squaredNorm(), (c - center).squaredNorm() }));
    this->Around.push_back({ center, radius, normal, normal.squaredNorm() });
  }
}

// Whether a triangle does not face the direction, or its sphere or plane is farther than a distance, with a margin for
// rounding.
bool TriangleGrid::IsFarther(
  int triangle, const Vector3d& point, const Vector3d& direction, double distance) const
{
  constexpr double margin = 1.000001;
  const Bounds& around = this->Around[triangle];
  const Vector3d offset = point - around.center;
  const double most = margin * (distance + around.radius);
  if (offset.squaredNorm() > most * most || direction.dot(around.normal) >= 0)
  {
    return true;
  }
  const double above = around.normal.dot(offset);
  return above * above > margin * distance * distance * around.squaredNormal;
}

void TriangleGrid::Compare(
  int triangle, const Vector3d& point, TrianglePlace& place, double& distance) const
{
  const auto& [i, j, k] = this->Corners[triangle];
  const Vector3d &a = this->Points[i], &b = this->Points[j], &c = this->Points[k];
  const Vector3d weights = NearestOnTriangle(point, a, b, c);
  const double found = (weights[0] * a + weights[1] * b + weights[2] * c - point).norm();
  if (found < distance || (found == distance && triangle < place.triangle))
  {
    distance = found;
    place = { triangle, weights };
  }
}

void TriangleGrid::Look(const Vector3d& point, const Vector3d& direction, double reach,
  TrianglePlace& place, double& distance) const
{
  const Vector3d around = Vector3d::Constant(reach);
  this->Grid.ForEachNear({ point - around, point + around },
    [&](int triangle, const BoxGrid::Cell&)
    {
      if (!this->IsFarther(triangle, point, direction, distance))
      {
        this->Compare(triangle, point, place, distance);
      }
    });
}

TrianglePlace TriangleGrid::Nearest(
  const Vector3d& point, const Vector3d& direction, double reach, int hint) const
{
  TrianglePlace place;
  if (!point.allFinite())
  {
    return place;
  }
  double distance = reach;
  if (hint >= 0 && !this->IsFarther(hint, point, direction, distance))
  {
    this->Compare(hint, point, place, distance);
  }
  // Mostly it is very near.
  for (const double share : { 0.05, 0.25 })
  {
    const double near = share * this->Side;
    if (near < distance)
    {
      this->Look(point, direction, near, place, distance);
      if (distance <= near)
      {
        return place;
      }
    }
  }
  this->Look(point, direction, distance, place, distance);
  return place;
}

}
