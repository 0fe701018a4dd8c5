// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/Lattice/Lattice.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

ContourLattice::ContourLattice(const AlignedBox3d& bounds, int cellsAlongLongestSide)
{
  const Vector3d size = bounds.sizes();
  this->spacing = size.maxCoeff() / (cellsAlongLongestSide - 1);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double across = size[axis] / this->spacing;
    this->cells[axis] = static_cast<int>(std::ceil(across - 1e-9)) + 1;
    this->origin[axis] = bounds.center()[axis] - 0.5 * this->spacing * this->cells[axis];
  }
}

int CellRange::Longest() const
{
  return std::max({ high[0] - low[0], high[1] - low[1], high[2] - low[2] });
}

AlignedBox3d CellRange::Box(const ContourLattice& lattice) const
{
  return AlignedBox3d(
    lattice.Point(low[0], low[1], low[2]), lattice.Point(high[0], high[1], high[2]));
}

std::vector<CellRange> CellRange::Parts(int step) const
{
  LatticeIndex middle;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int steps = (this->high[axis] - this->low[axis] + step - 1) / step;
    middle[axis] = std::min(this->low[axis] + (steps + 1) / 2 * step, this->high[axis]);
  }
  std::vector<CellRange> parts;
  for (int part = 0; part < 8; ++part)
  {
    CellRange range;
    bool empty = false;
    for (int axis = 0; axis < 3; ++axis)
    {
      const bool upper = (part >> axis & 1) != 0;
      range.low[axis] = upper ? middle[axis] : this->low[axis];
      range.high[axis] = upper ? this->high[axis] : middle[axis];
      empty = empty || range.low[axis] >= range.high[axis];
    }
    if (!empty)
    {
      parts.push_back(range);
    }
  }
  return parts;
}

}
