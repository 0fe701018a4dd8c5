// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Fit/TriangleGrid.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

using Eigen::Vector3d;

TriangleGrid::TriangleGrid(
  const std::vector<Vector3d>& points, const Triangles& triangles, double cell)
  : Points(points)
  , Corners(triangles)
  , Cell(cell)
{
  Eigen::AlignedBox3d box;
  for (const Vector3d& point : points)
  {
    box.extend(point);
  }
  if (!box.isEmpty())
  {
    this->Low = box.min();
  }
  this->FindBounds();
  this->ListTriangles();
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

void TriangleGrid::ListTriangles()
{
  while (std::size_t(1) << this->Bits < 2 * this->Corners.size() + 1)
  {
    ++this->Bits;
  }
  const auto visit = [&](auto&& body)
  {
    for (std::size_t t = 0; t < this->Corners.size(); ++t)
    {
      Eigen::AlignedBox3d around;
      for (const int corner : this->Corners[t])
      {
        around.extend(this->Points[corner]);
      }
      const Index low = this->CellOf(around.min()), high = this->CellOf(around.max());
      for (Index at = low; at.z() <= high.z(); ++at.z())
      {
        for (at.y() = low.y(); at.y() <= high.y(); ++at.y())
        {
          for (at.x() = low.x(); at.x() <= high.x(); ++at.x())
          {
            body(this->KeyOf(at), static_cast<std::int32_t>(t));
          }
        }
      }
    }
  };
  this->Begin.assign((std::size_t(1) << this->Bits) + 2, 0);
  visit([&](std::uint64_t key, std::int32_t) { ++this->Begin[key + 2]; });
  for (std::size_t i = 2; i < this->Begin.size(); ++i)
  {
    this->Begin[i] += this->Begin[i - 1];
  }
  this->List.resize(this->Begin.back());
  visit([&](std::uint64_t key, std::int32_t t) { this->List[this->Begin[key + 1]++] = t; });
}

TriangleGrid::Index TriangleGrid::CellOf(const Vector3d& point) const
{
  return ((point - this->Low) / this->Cell).array().floor().cast<std::int64_t>();
}

// Cells that share a place of the table cost time only.
std::uint64_t TriangleGrid::KeyOf(const Index& cell) const
{
  const std::uint64_t mixed = static_cast<std::uint64_t>(cell.x()) * 0x9e3779b97f4a7c15u +
    static_cast<std::uint64_t>(cell.y()) * 0xc2b2ae3d27d4eb4fu +
    static_cast<std::uint64_t>(cell.z()) * 0x165667b19e3779f9u;
  return this->Bits == 0 ? 0 : (mixed ^ mixed >> 29) * 0xbf58476d1ce4e5b9u >> (64 - this->Bits);
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
  const Index low = this->CellOf(point - Vector3d::Constant(reach));
  const Index high = this->CellOf(point + Vector3d::Constant(reach));
  for (Index at = low; at.z() <= high.z(); ++at.z())
  {
    for (at.y() = low.y(); at.y() <= high.y(); ++at.y())
    {
      for (at.x() = low.x(); at.x() <= high.x(); ++at.x())
      {
        const std::uint64_t key = this->KeyOf(at);
        for (std::uint32_t i = this->Begin[key]; i < this->Begin[key + 1]; ++i)
        {
          if (!this->IsFarther(this->List[i], point, direction, distance))
          {
            this->Compare(this->List[i], point, place, distance);
          }
        }
      }
    }
  }
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
    const double near = share * this->Cell;
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
