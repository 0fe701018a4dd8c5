// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BoxGrid_h
#define freespace_BoxGrid_h

#include "Common/GroupedLists.h"

#include <Eigen/Geometry>

#include <cstdint>

namespace freespace
{

/// A spatial index of boxes: a hashed grid, whose lists are parts of one array. Cells that share a place of the hash
/// table cost time only, unless a visitor compares cells.
class BoxGrid
{
public:
  using Cell = Eigen::Matrix<std::int64_t, 3, 1>;

  /// Of the boxes that boxOf(item) returns for the items from 0 to count. Cells should be somewhat larger than the
  /// boxes; `low` is their origin. O(n).
  template <typename BoxOf>
  BoxGrid(std::size_t count, const Eigen::Vector3d& low, double side, const BoxOf& boxOf)
    : Low(low)
    , Side(side)
  {
    while (std::size_t(1) << this->Bits < 2 * count + 1)
    {
      ++this->Bits;
    }
    const auto visit = [&](const auto& body)
    {
      for (std::size_t i = 0; i < count; ++i)
      {
        const auto item = static_cast<std::int32_t>(i);
        this->ForEachCell(boxOf(i), [&](const Cell& cell) { body(this->PlaceOf(cell), item); });
      }
    };
    this->Lists = GroupedLists<std::int32_t, std::uint32_t>(std::size_t(1) << this->Bits, visit);
  }

  Cell CellOf(const Eigen::Vector3d& point) const
  {
    return ((point - this->Low) / this->Side).array().floor().cast<std::int64_t>();
  }

  /// Calls visit(item, cell) for the items in each cell that a box touches; an item that is in several, as often.
  template <typename Visit>
  void ForEachNear(const Eigen::AlignedBox3d& box, const Visit& visit) const
  {
    this->ForEachCell(box,
      [&](const Cell& cell)
      {
        for (const std::int32_t item : this->Lists[this->PlaceOf(cell)])
        {
          visit(item, cell);
        }
      });
  }

private:
  template <typename Visit>
  void ForEachCell(const Eigen::AlignedBox3d& box, const Visit& visit) const
  {
    const Cell low = this->CellOf(box.min()), high = this->CellOf(box.max());
    for (Cell at = low; at.z() <= high.z(); ++at.z())
    {
      for (at.y() = low.y(); at.y() <= high.y(); ++at.y())
      {
        for (at.x() = low.x(); at.x() <= high.x(); ++at.x())
        {
          visit(at);
        }
      }
    }
  }

  std::uint64_t PlaceOf(const Cell& cell) const
  {
    const std::uint64_t mixed = static_cast<std::uint64_t>(cell.x()) * 0x9e3779b97f4a7c15u +
      static_cast<std::uint64_t>(cell.y()) * 0xc2b2ae3d27d4eb4fu +
      static_cast<std::uint64_t>(cell.z()) * 0x165667b19e3779f9u;
    return this->Bits == 0 ? 0 : (mixed ^ mixed >> 29) * 0xbf58476d1ce4e5b9u >> (64 - this->Bits);
  }

  Eigen::Vector3d Low;
  double Side;
  int Bits = 0;                                    // of the table's size
  GroupedLists<std::int32_t, std::uint32_t> Lists; // per place, its items
};

}

#endif
