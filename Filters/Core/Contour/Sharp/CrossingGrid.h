// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_CrossingGrid_h
#define freespace_CrossingGrid_h

#include "Contour/Sharp/BlockMesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace freespace
{

/// The crossings of a block's cells and of those that touch them, by lattice edge. Indices of
/// points and cells are relative to the block.
struct CrossingGrid
{
  static constexpr int Side = ContourBlock::Size + 3; ///< points -1 to Size + 1
  std::vector<SurfacePlane> crossings;
  std::array<std::int32_t, 3 * Side * Side * Side> at; ///< 1 + place in the crossings; 0: none

  static bool Has(const LatticeIndex& point)
  {
    return std::all_of(
      point.begin(), point.end(), [](int index) { return index >= -1 && index < Side - 1; });
  }
  static int Place(const LatticeIndex& point, int axis)
  {
    return 3 * (((point[2] + 1) * Side + point[1] + 1) * Side + point[0] + 1) + axis;
  }
  void Add(const LatticeIndex& point, int axis, std::vector<SurfacePlane>& planes) const
  {
    if (const int crossing = this->at[Place(point, axis)])
    {
      planes.push_back(this->crossings[crossing - 1]);
    }
  }

  /// Adds those of all lattice edges that begin at a point of a cell or of one that touches it.
  void AddAround(const LatticeIndex& cell, std::vector<SurfacePlane>& planes) const;

  /// Collects the crossings of a block and of the 26 around it.
  void Fill(const BlockMesh& blocks, const BlockPlace& place);
};

}

#endif
