// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/Sharp/FaceJoiner.h"

namespace freespace
{

using Eigen::Vector3d;

void FaceJoiner::JoinFaces(BlockPlace& place) const
{
  const ContourBlock& block = *place.block;
  FieldScope scope;
  for (std::size_t c = 0; c < block.cells.size(); ++c)
  {
    if (MarchingCubesCases::AmbiguousFaces(block.cases[c]) == 0)
    {
      continue;
    }
    scope = scope.views.empty() && scope.planes.empty()
      ? this->Blocks.ScopeAround(this->Field, block)
      : scope;
    const LatticeIndex cell = this->Blocks.LatticeCell(block, c);
    const int wanted = this->FacesToJoin(cell, block.cases[c], scope);
    int joined = 0;
    for (int face = 0; face < 6; ++face)
    {
      if (wanted >> face & 1)
      {
        LatticeIndex beside = cell;
        beside[face >> 1] += (face & 1) ? 1 : -1;
        const int others = this->FacesToJoin(beside, this->Blocks.CaseOf(beside), scope);
        joined |= (others >> (face ^ 1) & 1) << face;
      }
    }
    if (joined != 0)
    {
      place.joined.push_back({ c, joined });
    }
  }
}

// The ambiguous faces of a cell with matter in their middles, if they can be joined.
int FaceJoiner::FacesToJoin(const LatticeIndex& cell, int matter, const FieldScope& scope) const
{
  int faces = MarchingCubesCases::AmbiguousFaces(matter);
  for (int face = 0; face < 6; ++face)
  {
    if (faces >> face & 1)
    {
      LatticeIndex low = cell;
      low[face >> 1] += face & 1;
      Vector3d middle = this->Blocks.lattice.Point(low[0], low[1], low[2]);
      middle += 0.5 * this->Blocks.lattice.spacing * (Vector3d::Ones() - Vector3d::Unit(face >> 1));
      faces ^= this->Field.IsFree(middle, scope) << face;
    }
  }
  return MarchingCubesCases::Get().CanJoin(matter, faces) ? faces : 0;
}

}
