// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/Sharp/CrossingGrid.h"

namespace freespace
{

void CrossingGrid::AddAround(const LatticeIndex& cell, std::vector<SurfacePlane>& planes) const
{
  for (int k = -1; k <= 2; ++k)
  {
    for (int j = -1; j <= 2; ++j)
    {
      for (int i = -1; i <= 2; ++i)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          this->Add({ cell[0] + i, cell[1] + j, cell[2] + k }, axis, planes);
        }
      }
    }
  }
}

void CrossingGrid::Fill(const BlockMesh& blocks, const BlockPlace& place)
{
  this->at.fill(0);
  const int size = ContourBlock::Size;
  for (int n = 0; n < 27; ++n)
  {
    const LatticeIndex offset = { n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1 };
    const LatticeIndex& at = place.block->at;
    const BlockPlace* other =
      blocks.FindPlace({ at[0] + offset[0], at[1] + offset[1], at[2] + offset[2] });
    for (std::size_t v = 0; other && v < other->block->keys.size(); ++v)
    {
      LatticeIndex point = ContourBlock::PointOf(other->block->keys[v]);
      for (int a = 0; a < 3; ++a)
      {
        point[a] += size * offset[a];
      }
      if (Has(point))
      {
        this->crossings.push_back(
          { other->block->Position(blocks.lattice, v), other->block->normals[v].cast<double>() });
        this->at[Place(point, other->block->keys[v] % 3)] =
          static_cast<std::int32_t>(this->crossings.size());
      }
    }
  }
}

}
