// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/Sharp/BlockMesh.h"

#include <algorithm>

namespace freespace
{

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

void BlockMesh::Add(const std::vector<Region>& regions)
{
  std::size_t count = 0;
  for (const Region& region : regions)
  {
    count += region.blocks.size();
  }
  this->places.reserve(count);
  this->Index.reserve(count);
  for (std::size_t r = 0; r < regions.size(); ++r)
  {
    const Region& region = regions[r];
    if (r == 0 || region.layer != regions[r - 1].layer)
    {
      this->layers.push_back({ r, this->places.size() });
    }
    for (const ContourBlock& block : region.blocks)
    {
      this->Index[LatticeKey(block.at)] = this->places.size();
      this->places.push_back({ &block, region.isOwn, 0, 0, {}, {}, {}, {}, {}, {} });
    }
  }
  this->layers.push_back({ regions.size(), this->places.size() });
}

LatticeIndex BlockMesh::LatticeCell(const ContourBlock& block, std::size_t c) const
{
  LatticeIndex cell = CellOf(block.cells[c]);
  for (int axis = 0; axis < 3; ++axis)
  {
    cell[axis] += ContourBlock::Size * block.at[axis];
  }
  return cell;
}

Vector3d BlockMesh::CellCorner(const ContourBlock& block, const LatticeIndex& cell) const
{
  const int size = ContourBlock::Size;
  return this->lattice.Point(
    size * block.at[0] + cell[0], size * block.at[1] + cell[1], size * block.at[2] + cell[2]);
}

AlignedBox3d BlockMesh::CellBox(const LatticeIndex& cell, double rim) const
{
  const Vector3d low = this->lattice.Point(cell[0], cell[1], cell[2]);
  const double room = rim * this->lattice.spacing;
  return { low - Vector3d::Constant(room), low + Vector3d::Constant(this->lattice.spacing + room) };
}

FieldScope BlockMesh::ScopeAround(const BoundedField& field, const ContourBlock& block) const
{
  const double size = ContourBlock::Size;
  const Vector3d low = this->CellCorner(block, { -2, -2, -2 });
  const AlignedBox3d box(low, low + Vector3d::Constant((size + 4) * this->lattice.spacing));
  FieldScope scope;
  return field.Classify(box, field.Root(), scope) == BoxContent::Mixed ? scope : field.Root();
}

const BlockPlace* BlockMesh::PlaceOf(LatticeIndex& index) const
{
  LatticeIndex at;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (index[axis] < 0)
    {
      return nullptr;
    }
    at[axis] = index[axis] / ContourBlock::Size;
    index[axis] %= ContourBlock::Size;
  }
  const auto place = this->Index.find(LatticeKey(at));
  return place == this->Index.end() ? nullptr : &this->places[place->second];
}

BlockPlace* BlockMesh::FindPlace(const LatticeIndex& at) const
{
  const auto place = this->Index.find(LatticeKey(at));
  return place == this->Index.end() ? nullptr
                                    : const_cast<BlockPlace*>(&this->places[place->second]);
}

bool BlockMesh::FindCell(LatticeIndex cell, const BlockPlace*& place, std::size_t& c) const
{
  place = this->PlaceOf(cell);
  if (!place)
  {
    return false;
  }
  const auto& cells = place->block->cells;
  const std::uint16_t wanted = ContourBlock::CellKey(cell);
  const auto found = std::lower_bound(cells.begin(), cells.end(), wanted);
  c = found - cells.begin();
  return found != cells.end() && *found == wanted;
}

int BlockMesh::CaseOf(const LatticeIndex& cell) const
{
  const BlockPlace* place = nullptr;
  std::size_t c = 0;
  return this->FindCell(cell, place, c) ? place->block->cases[c] : 0;
}

bool BlockMesh::FindCorner(const BlockPlace& place, const LatticeIndex& cell, int edge,
  Neighbors& neighbors, BlockVertex& corner) const
{
  const int size = ContourBlock::Size;
  const LatticeIndex point = FirstPoint(cell, edge);
  BlockPlace*& owner = neighbors[point[0] / size | point[1] / size << 1 | point[2] / size << 2];
  corner.vertex = this->FindVertex(place, point, edge >> 2, owner);
  corner.owner = owner;
  return corner.vertex != Missing;
}

std::size_t BlockMesh::FindVertex(
  const BlockPlace& from, LatticeIndex point, int axis, BlockPlace*& owner) const
{
  if (!owner)
  {
    LatticeIndex at = from.block->at;
    for (int a = 0; a < 3; ++a)
    {
      at[a] += point[a] / ContourBlock::Size;
    }
    owner = this->FindPlace(at);
    if (!owner)
    {
      return Missing;
    }
  }
  for (int& index : point)
  {
    index %= ContourBlock::Size;
  }
  return VertexAt(*owner->block, point, axis);
}

SurfacePlane BlockMesh::PlaneAt(const BlockVertex& vertex) const
{
  return { vertex.owner->block->Position(this->lattice, vertex.vertex),
    vertex.owner->block->normals[vertex.vertex].cast<double>() };
}

bool BlockMesh::CollectPlanes(const LatticeIndex& cell, std::vector<SurfacePlane>& planes) const
{
  const BlockPlace* owner = nullptr;
  std::size_t c = 0;
  if (!this->FindCell(cell, owner, c) || LoopsOf(*owner, c).size() != 1)
  {
    return false;
  }
  for (int edge : LoopsOf(*owner, c)[0])
  {
    LatticeIndex point = FirstPoint(cell, edge);
    owner = this->PlaceOf(point);
    const std::size_t vertex = owner ? VertexAt(*owner->block, point, edge >> 2) : Missing;
    if (vertex == Missing)
    {
      return false;
    }
    planes.push_back({ owner->block->Position(this->lattice, vertex),
      owner->block->normals[vertex].cast<double>() });
  }
  return true;
}

bool BlockMesh::FindSharp(const BlockPlace& from, LatticeIndex cell, BlockVertex& found) const
{
  const int size = ContourBlock::Size;
  LatticeIndex at = from.block->at;
  for (int a = 0; a < 3; ++a)
  {
    at[a] += (cell[a] + size) / size - 1;
    cell[a] = (cell[a] + size) % size;
  }
  found.owner = at == from.block->at ? const_cast<BlockPlace*>(&from) : this->FindPlace(at);
  if (!found.owner)
  {
    return false;
  }
  const auto& cells = found.owner->block->cells;
  const auto& sharp = found.owner->sharp;
  const int place = (cell[2] * size + cell[1]) * size + cell[0];
  const auto vertex = std::lower_bound(sharp.begin(), sharp.end(), place,
    [&cells](const SharpVertex& v, int wanted) { return cells[v.cell] < wanted; });
  found.vertex = found.owner->block->keys.size() + (vertex - sharp.begin());
  return vertex != sharp.end() && cells[vertex->cell] == place;
}

bool BlockMesh::FindSharpFace(
  const BlockPlace& place, std::size_t sharp, int face, SharpFace& sharpFace) const
{
  const SharpVertex& own = place.sharp[sharp];
  LatticeIndex cell = CellOf(place.block->cells[own.cell]);
  sharpFace.axis = face >> 1;
  sharpFace.isUpper = (face & 1) != 0;
  LatticeIndex other = cell;
  other[sharpFace.axis] += sharpFace.isUpper ? 1 : -1;
  cell[sharpFace.axis] += sharpFace.isUpper ? 1 : 0;
  sharpFace.low = this->CellCorner(*place.block, cell);
  return !MarchingCubesCases::IsAmbiguous(place.block->cases[own.cell], face) &&
    this->FindSharp(place, other, sharpFace.other);
}

bool BlockMesh::IsThroughFace(
  const Vector3d& own, const Vector3d& other, const SharpFace& face) const
{
  const Vector3d &lower = face.isUpper ? own : other, &upper = face.isUpper ? other : own;
  const int axis = face.axis;
  const double from = lower[axis] - face.low[axis], to = upper[axis] - face.low[axis];
  const Vector3d through = lower + from / (from - to) * (upper - lower);
  const double room = 0.5 * SharpClearance * this->lattice.spacing;
  bool isInside = from * to < 0;
  for (int across : { (axis + 1) % 3, (axis + 2) % 3 })
  {
    const double place = through[across] - face.low[across];
    isInside = isInside && place > room && place < this->lattice.spacing - room;
  }
  return isInside;
}

void BlockMesh::JoinSharp(
  const BlockPlace& place, std::size_t sharp, int face, BlockVertex& last) const
{
  const SharpVertex& own = place.sharp[sharp];
  SharpFace sharpFace;
  if (this->FindSharpFace(place, sharp, face, sharpFace))
  {
    const SharpVertex& other = SharpOf(sharpFace.other);
    const bool isLinked = std::any_of(place.links.begin(), place.links.end(),
      [&](const FaceLink& link) { return link.cell == own.cell && link.face == face; });
    const bool areOwn = own.reach == Reach::Own && other.reach == Reach::Own;
    if (isLinked || (areOwn && this->IsThroughFace(own.position, other.position, sharpFace)))
    {
      last = sharpFace.other;
    }
  }
}

}
