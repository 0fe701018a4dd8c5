// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/FeatureGrid.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

// Number of bits of a cell's coordinate; features beyond share the last cell.
constexpr int Bits = 21;
constexpr double MostCellsOfAxis = (1 << Bits) - 1;

}

FeatureGrid::FeatureGrid(const std::vector<Vector3d>& points, double reach)
  : Reach(reach)
  , Side(2 * reach)
{
  Eigen::AlignedBox3d box;
  for (const Vector3d& point : points)
  {
    if (point.allFinite())
    {
      this->Points.push_back(point);
      box.extend(point);
    }
  }
  if (this->Points.empty())
  {
    return;
  }
  // A cell begins one side below, so that no place near a feature has a lower one.
  this->Side = std::max(this->Side, 1e-6 * box.sizes().maxCoeff());
  if (this->Side == 0)
  {
    this->Side = 1; // all points coincide: any cell will do
  }
  this->Origin = box.min() - Vector3d::Constant(this->Side);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  for (const Vector3d& point : this->Points)
  {
    order.emplace_back(KeyOf(this->CellOf(point)), static_cast<std::uint32_t>(order.size()));
  }
  std::sort(order.begin(), order.end());
  std::vector<Vector3d> sorted;
  for (const auto& [key, index] : order)
  {
    auto& cell = this->Cells.emplace(key, std::pair(sorted.size(), sorted.size())).first->second;
    sorted.push_back(this->Points[index]);
    cell.second = static_cast<std::uint32_t>(sorted.size());
  }
  this->Points = std::move(sorted);
}

FeatureGrid::Index FeatureGrid::CellOf(const Vector3d& place) const
{
  const Vector3d at = ((place - this->Origin) / this->Side).array().floor();
  return at.cwiseMax(0.0).cwiseMin(MostCellsOfAxis).cast<std::int64_t>();
}

std::uint64_t FeatureGrid::KeyOf(const Index& cell)
{
  return static_cast<std::uint64_t>((cell.z() << 2 * Bits) | (cell.y() << Bits) | cell.x());
}

bool FeatureGrid::IsNear(const Vector3d& place) const
{
  if (this->Points.empty() || !place.allFinite())
  {
    return false;
  }
  const Vector3d reach = Vector3d::Constant(this->Reach);
  const Index low = this->CellOf(place - reach), high = this->CellOf(place + reach);
  for (std::int64_t z = low.z(); z <= high.z(); ++z)
  {
    for (std::int64_t y = low.y(); y <= high.y(); ++y)
    {
      for (std::int64_t x = low.x(); x <= high.x(); ++x)
      {
        const auto cell = this->Cells.find(KeyOf({ x, y, z }));
        if (cell == this->Cells.end())
        {
          continue;
        }
        for (std::uint32_t i = cell->second.first; i < cell->second.second; ++i)
        {
          if ((this->Points[i] - place).squaredNorm() <= this->Reach * this->Reach)
          {
            return true;
          }
        }
      }
    }
  }
  return false;
}

}
