// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/Sharp/SharpVertexFinder.h"

#include "Contour/Sharp/CrossingGrid.h"
#include "Contour/Sharp/FaceJoiner.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

namespace
{

class SharpVertexFinder
{
public:
  SharpVertexFinder(const BoundedField& field, BlockMesh& blocks, double sharpAngle)
    : Field(field)
    , Blocks(blocks)
    , SharpCosine(std::cos(sharpAngle * M_PI / 180.0))
    , HalfSharpCosine(std::cos(sharpAngle * M_PI / 360.0))
  {
  }

  void Find(const Progress& progress, const ParallelFor& parallelFor);

private:
  void FindSharpVertices(BlockPlace& place) const;
  void FindSharpVertex(
    BlockPlace& place, std::size_t c, CrossingGrid& grid, FieldScope& scope) const;
  std::vector<SharpFeature> CornersNearby(const LatticeIndex& cell, const SharpFeature& edge) const;
  void AddSharpVertex(BlockPlace& place, std::size_t c, std::vector<SharpFeature>& features,
    const std::vector<SurfacePlane>& planes, const FieldScope& scope, bool mayTrust) const;
  bool Settle(const LatticeIndex& cell, SharpFeature& feature, Reach& reach) const;
  bool PutOnSurface(Vector3d& position, const Vector3d& up, const AlignedBox3d& inner,
    const std::function<bool(const Vector3d&)>& isFree) const;
  void Offer(
    const LatticeIndex& cell, const SharpFeature& feature, std::vector<SharpOffer>& offers) const;
  void HandOverOffers();
  void TakeOffers(BlockPlace& place) const;
  void KeepCornersApart();
  static Vector3d Clamp(const Vector3d& point, const AlignedBox3d& box);
  static Vector3d MiddleOf(const std::vector<SurfacePlane>& planes);

  /// Radius of the smoothing of normals before sharp edges are detected, in cells.
  static constexpr double SmoothingRadius = 1.5;

  const BoundedField& Field;
  BlockMesh& Blocks;
  const double SharpCosine, HalfSharpCosine;
};

void SharpVertexFinder::Find(const Progress& progress, const ParallelFor& parallelFor)
{
  const FaceJoiner joiner(this->Field, this->Blocks);
  this->Blocks.ForEachPlace(progress.Part(0.0, 0.2), parallelFor,
    [&](std::size_t i) { joiner.JoinFaces(this->Blocks.places[i]); });
  this->Blocks.ForEachPlace(progress.Part(0.2, 0.8), parallelFor,
    [this](std::size_t i) { this->FindSharpVertices(this->Blocks.places[i]); });
  this->HandOverOffers();
  this->Blocks.ForEachPlace(progress.Part(0.8, 1.0), parallelFor,
    [this](std::size_t i) { this->TakeOffers(this->Blocks.places[i]); });
  this->KeepCornersApart();
}

// Adds a vertex to each cell of a block that contains a sharp edge or corner.
void SharpVertexFinder::FindSharpVertices(BlockPlace& place) const
{
  FieldScope scope;
  CrossingGrid grid;
  for (std::size_t c = 0; c < place.block->cells.size(); ++c)
  {
    const std::size_t before = place.sharp.size();
    this->FindSharpVertex(place, c, grid, scope);
    if (place.sharp.size() == before &&
      MarchingCubesCases::Get().NeedsMiddle(
        place.block->cases[c], BlockMesh::JoinedFacesOf(place, c)))
    {
      const LatticeIndex cell = this->Blocks.LatticeCell(*place.block, c);
      std::vector<SurfacePlane> planes;
      const Vector3d middle = this->Blocks.CollectPlanes(cell, planes)
        ? Clamp(MiddleOf(planes), this->Blocks.CellBox(cell, -BlockMesh::SharpClearance))
        : Vector3d(this->Blocks.CellBox(cell, 0.0).center());
      place.sharp.push_back({ c, middle, middle, middle, Reach::Own, false, false, Reach::Own });
    }
  }
}

// The same for one cell. The grid and the scope are those of the block, filled when first needed.
void SharpVertexFinder::FindSharpVertex(
  BlockPlace& place, std::size_t c, CrossingGrid& grid, FieldScope& scope) const
{
  const ContourBlock& block = *place.block;
  const auto& loops = BlockMesh::LoopsOf(place, c);
  if (loops.size() != 1)
  {
    return;
  }
  if (grid.crossings.empty())
  {
    grid.Fill(this->Blocks, place);
  }
  std::vector<SurfacePlane> planes, around;
  for (int edge : loops[0])
  {
    grid.Add(BlockMesh::FirstPoint(BlockMesh::CellOf(block.cells[c]), edge), edge >> 2, planes);
  }
  if (planes.size() != loops[0].size() || !NormalsDiffer(planes, this->HalfSharpCosine))
  {
    return; // most cells
  }
  grid.AddAround(BlockMesh::CellOf(block.cells[c]), around);
  SmoothNormals(planes, around, SmoothingRadius * this->Blocks.lattice.spacing);
  SharpFeature own;
  if (!FindSharpFeature(planes, this->SharpCosine, own))
  {
    return;
  }
  const LatticeIndex cell = this->Blocks.LatticeCell(block, c);
  scope = scope.views.empty() && scope.planes.empty() ? this->Blocks.ScopeAround(this->Field, block)
                                                      : scope;
  std::vector<SharpFeature> features = this->CornersNearby(cell, own);
  features.push_back(own);
  this->AddSharpVertex(place, c, features, planes, scope, true);
  for (const SharpFeature& feature : features)
  {
    this->Offer(cell, feature, place.offers);
  }
}

// The corners where a cell's sharp edge meets planes of the adjacent cells.
std::vector<SharpFeature> SharpVertexFinder::CornersNearby(
  const LatticeIndex& cell, const SharpFeature& edge) const
{
  std::vector<SharpFeature> corners;
  for (int side = 0; side < 6 && !edge.IsCorner(); ++side)
  {
    LatticeIndex beside = cell;
    beside[side >> 1] += (side & 1) ? 1 : -1;
    std::vector<SurfacePlane> planes;
    this->Blocks.CollectPlanes(beside, planes);
    for (const SurfacePlane& plane : planes)
    {
      SharpFeature corner;
      if (FindCornerOnEdge(edge, plane, this->SharpCosine, corner))
      {
        corners.push_back(corner);
      }
    }
  }
  return corners;
}

// Adds a vertex at the first of the features that is within reach and confirmed by the field.
void SharpVertexFinder::AddSharpVertex(BlockPlace& place, std::size_t c,
  std::vector<SharpFeature>& features, const std::vector<SurfacePlane>& planes,
  const FieldScope& scope, bool mayTrust) const
{
  const LatticeIndex cell = this->Blocks.LatticeCell(*place.block, c);
  const AlignedBox3d inner = this->Blocks.CellBox(cell, -BlockMesh::SharpClearance);
  const auto isFree = [&](const Vector3d& point) { return this->Field.IsFree(point, scope); };
  // The feature of the cell's own planes, clamped to the cell.
  SharpFeature last = features.back();
  const bool isNear = last.SlideInto(inner) || mayTrust;
  Vector3d middle = Clamp(isNear ? last.position : MiddleOf(planes), inner);
  const bool mayGuess = mayTrust && this->PutOnSurface(middle, last.Up(), inner, isFree);
  SharpVertex vertex = { c, middle, middle, middle, Reach::Own, false, false, Reach::Own };
  bool isFound = false;
  for (SharpFeature& feature : features)
  {
    Reach reach;
    if (!this->Settle(cell, feature, reach))
    {
      continue;
    }
    const bool isOwn = reach == Reach::Own;
    Vector3d position = isOwn ? Clamp(feature.position, inner) : feature.position;
    const bool isTrusted = mayTrust && !feature.isBorrowed && isOwn &&
      this->PutOnSurface(position, feature.Up(), inner, isFree);
    if (!isTrusted &&
      !feature.IsConfirmed(BlockMesh::FeatureReach * this->Blocks.lattice.spacing, isFree))
    {
      continue;
    }
    if (!isFound)
    {
      vertex.position = position;
      vertex.reach = reach;
      vertex.isCorner = feature.IsCorner();
      vertex.isBorrowed = feature.isBorrowed;
      isFound = true;
    }
    if (!feature.IsCorner())
    {
      vertex.edge = position;
      vertex.edgeReach = reach;
      vertex.fallback = isOwn ? position : vertex.fallback;
      break;
    }
  }
  if (isFound || mayGuess)
  {
    place.sharp.push_back(vertex);
  }
}

// Moves a feature of a cell into the cell, or else into the nearest adjacent cell that is empty in
// the lattice: a thin wedge may reach into it without containing any of its corners. An edge that
// passes only through cells of the surface is left in one of them: there the lattice may have two
// components that in fact are connected.
bool SharpVertexFinder::Settle(const LatticeIndex& cell, SharpFeature& feature, Reach& reach) const
{
  reach = Reach::Own;
  if (feature.SlideInto(this->Blocks.CellBox(cell, -BlockMesh::SharpClearance)) ||
    feature.SlideInto(this->Blocks.CellBox(cell, BlockMesh::SharpClearance)))
  {
    return true;
  }
  double least = HUGE_VAL;
  SharpFeature nearest = feature;
  for (int n = 0; n < 27; ++n)
  {
    const LatticeIndex beside = BlockMesh::Beside(cell, n);
    SharpFeature moved = feature;
    if (moved.SlideInto(this->Blocks.CellBox(beside, 0.0)) &&
      (moved.position - feature.position).norm() < least && this->Blocks.CaseOf(beside) == 0)
    {
      least = (moved.position - feature.position).norm();
      nearest = moved;
    }
  }
  feature = nearest;
  reach = least < HUGE_VAL ? Reach::Empty : Reach::Surface;
  return reach == Reach::Empty ||
    (!feature.IsCorner() && this->Blocks.CellBox(cell, 1.0).contains(feature.position));
}

// Where the surface is rough, the planes are only an estimate: a position that the field
// contradicts is moved to the surface, within the cell. False where the surface is not found: no
// vertex is better.
bool SharpVertexFinder::PutOnSurface(Vector3d& position, const Vector3d& up,
  const AlignedBox3d& inner, const std::function<bool(const Vector3d&)>& isFree) const
{
  const Vector3d slack = BlockMesh::VertexSlack * this->Blocks.lattice.spacing * up;
  return (isFree(position + slack) && !isFree(position - slack)) ||
    MoveToBoundary(position, up, inner, isFree);
}

// Offers a feature to the adjacent cells that it passes, whose own crossings may not show it.
void SharpVertexFinder::Offer(
  const LatticeIndex& cell, const SharpFeature& feature, std::vector<SharpOffer>& offers) const
{
  for (int n = 0; n < 27; ++n)
  {
    const LatticeIndex beside = BlockMesh::Beside(cell, n);
    SharpFeature moved = feature;
    if (beside != cell &&
      moved.SlideInto(this->Blocks.CellBox(beside, BlockMesh::SharpClearance)) &&
      this->Blocks.CaseOf(beside) != 0)
    {
      offers.push_back({ beside, feature });
    }
  }
}

void SharpVertexFinder::HandOverOffers()
{
  for (BlockPlace& place : this->Blocks.places)
  {
    for (SharpOffer& offer : place.offers)
    {
      const BlockPlace* receiver = this->Blocks.PlaceOf(offer.cell);
      const_cast<BlockPlace*>(receiver)->received.push_back(std::move(offer));
    }
    place.offers = {};
  }
}

// Adds vertices at offered features to cells without a sharp vertex, and replaces vertices on edges
// by offered corners.
void SharpVertexFinder::TakeOffers(BlockPlace& place) const
{
  if (place.received.empty())
  {
    return;
  }
  const auto cellOf = [](const SharpOffer& offer) { return ContourBlock::CellKey(offer.cell); };
  std::stable_sort(place.received.begin(), place.received.end(),
    [&](const SharpOffer& a, const SharpOffer& b)
    {
      return std::make_pair(cellOf(a), !a.feature.IsCorner()) <
        std::make_pair(cellOf(b), !b.feature.IsCorner());
    });
  const FieldScope scope = this->Blocks.ScopeAround(this->Field, *place.block);
  std::vector<SharpVertex> own = std::move(place.sharp);
  place.sharp.clear();
  std::size_t next = 0, o = 0;
  for (std::size_t c = 0; c < place.block->cells.size(); ++c)
  {
    std::vector<SharpFeature> features;
    for (; o < place.received.size() && cellOf(place.received[o]) == place.block->cells[c]; ++o)
    {
      features.push_back(place.received[o].feature);
    }
    const bool isSharp = next < own.size() && own[next].cell == c;
    if (isSharp)
    {
      features.erase(
        std::remove_if(features.begin(), features.end(),
          [&](const SharpFeature& feature) { return own[next].isCorner || !feature.IsCorner(); }),
        features.end());
    }
    const std::size_t before = place.sharp.size();
    std::vector<SurfacePlane> planes;
    const LatticeIndex cell = this->Blocks.LatticeCell(*place.block, c);
    if (!features.empty() && this->Blocks.CollectPlanes(cell, planes))
    {
      const Vector3d middle = MiddleOf(planes);
      for (SharpFeature& feature : features)
      {
        feature.position += feature.direction.dot(middle - feature.position) * feature.direction;
      }
      this->AddSharpVertex(place, c, features, planes, scope, false);
    }
    if (isSharp && place.sharp.size() == before)
    {
      place.sharp.push_back(own[next]);
    }
    next += isSharp;
  }
  place.received = {};
}

// Where several cells found the same corner outside of themselves, keeps it in the cell that needs
// no planes of other cells, or else in the first.
void SharpVertexFinder::KeepCornersApart()
{
  std::vector<SharpVertex*> corners;
  for (BlockPlace& place : this->Blocks.places)
  {
    for (SharpVertex& vertex : place.sharp)
    {
      if (vertex.isCorner && vertex.reach != Reach::Own)
      {
        corners.push_back(&vertex);
      }
    }
  }
  std::stable_sort(corners.begin(), corners.end(),
    [](const SharpVertex* a, const SharpVertex* b) { return a->position.x() < b->position.x(); });
  const double reach = BlockMesh::FeatureReach * this->Blocks.lattice.spacing;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    for (std::size_t j = i + 1; j < corners.size() && corners[i]->reach != Reach::Own &&
         corners[j]->position.x() - corners[i]->position.x() < reach;
         ++j)
    {
      if (corners[j]->reach != Reach::Own &&
        (corners[j]->position - corners[i]->position).norm() < reach)
      {
        const bool isFirst = corners[i]->isBorrowed <= corners[j]->isBorrowed;
        SharpVertex& other = *corners[isFirst ? j : i];
        other.position = other.edge;
        other.reach = other.edgeReach;
        other.isCorner = false;
      }
    }
  }
}

Vector3d SharpVertexFinder::Clamp(const Vector3d& point, const AlignedBox3d& box)
{
  return point.cwiseMax(box.min()).cwiseMin(box.max());
}

Vector3d SharpVertexFinder::MiddleOf(const std::vector<SurfacePlane>& planes)
{
  Vector3d middle = Vector3d::Zero();
  for (const SurfacePlane& plane : planes)
  {
    middle += plane.point / static_cast<double>(planes.size());
  }
  return middle;
}

}

void FindSharpEdges(const BoundedField& field, double sharpAngle, BlockMesh& blocks,
  const Progress& progress, const ParallelFor& parallelFor)
{
  SharpVertexFinder(field, blocks, sharpAngle).Find(progress, parallelFor);
}

}
