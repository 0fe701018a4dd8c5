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
  this->FindPlanes();
  this->ListTriangles();
}

void TriangleGrid::FindPlanes()
{
  this->Planes.reserve(this->Corners.size());
  for (const auto& [a, b, c] : this->Corners)
  {
    const Vector3d& corner = this->Points[a];
    const Vector3d normal = (this->Points[b] - corner).cross(this->Points[c] - corner);
    this->Planes.push_back({ corner, normal, normal.squaredNorm() });
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
          const int t = this->List[i];
          const Plane& plane = this->Planes[t];
          if (direction.dot(plane.normal) >= 0)
          {
            continue;
          }
          // Farther from the triangle's plane than the nearest place so far, with a margin for rounding.
          const double above = plane.normal.dot(point - plane.corner);
          if (above * above > 1.000001 * distance * distance * plane.squaredNormal)
          {
            continue;
          }
          const Vector3d &a = plane.corner, &b = this->Points[this->Corners[t][1]],
                         &c = this->Points[this->Corners[t][2]];
          const Vector3d weights = NearestOnTriangle(point, a, b, c);
          const double found = (weights[0] * a + weights[1] * b + weights[2] * c - point).norm();
          if (found < distance || (found == distance && t < place.triangle))
          {
            distance = found;
            place = { t, weights };
          }
        }
      }
    }
  }
}

TrianglePlace TriangleGrid::Nearest(
  const Vector3d& point, const Vector3d& direction, double reach) const
{
  TrianglePlace place;
  if (!point.allFinite())
  {
    return place;
  }
  double distance = reach;
  // Mostly it is very near.
  const double near = 0.25 * this->Cell;
  if (near < reach)
  {
    this->Look(point, direction, near, place, distance);
  }
  if (place.triangle < 0 || distance > near)
  {
    this->Look(point, direction, distance, place, distance);
  }
  return place;
}

}
