// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/Sharp/SharpVertexFinder.h"

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

  void Find(const Progress& progress, const ParallelFor& parallelFor)
  {
    this->Blocks.ForEachPlace(progress.Part(0.0, 0.2), parallelFor,
      [this](std::size_t i) { this->JoinFaces(this->Blocks.places[i]); });
    this->Blocks.ForEachPlace(progress.Part(0.2, 0.8), parallelFor,
      [this](std::size_t i) { this->FindSharpVertices(this->Blocks.places[i]); });
    this->HandOverOffers();
    this->Blocks.ForEachPlace(progress.Part(0.8, 1.0), parallelFor,
      [this](std::size_t i) { this->TakeOffers(this->Blocks.places[i]); });
    this->KeepCornersApart();
  }

private:
  /// Joins the matter across faces that a wedge passes along their diagonal. The lattice alone parts
  /// it there; the field knows better. Both cells of a face come to the same answer.
  void JoinFaces(BlockPlace& place) const
  {
    const ContourBlock& block = *place.block;
    FieldScope scope;
    for (std::size_t c = 0; c < block.cells.size(); ++c)
    {
      if (MarchingCubesCases::AmbiguousFaces(block.cases[c]) == 0)
      {
        continue;
      }
      scope = scope.views.empty() && scope.planes.empty() ? this->ScopeAround(block) : scope;
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

  /// The ambiguous faces of a cell in whose middles is matter, if they can be joined.
  int FacesToJoin(const LatticeIndex& cell, int matter, const FieldScope& scope) const
  {
    int faces = MarchingCubesCases::AmbiguousFaces(matter);
    for (int face = 0; face < 6; ++face)
    {
      if (faces >> face & 1)
      {
        LatticeIndex low = cell;
        low[face >> 1] += face & 1;
        Vector3d middle = this->Blocks.lattice.Point(low[0], low[1], low[2]);
        middle +=
          0.5 * this->Blocks.lattice.spacing * (Vector3d::Ones() - Vector3d::Unit(face >> 1));
        faces ^= this->Field.IsFree(middle, scope) << face;
      }
    }
    return MarchingCubesCases::Get().CanJoin(matter, faces) ? faces : 0;
  }

  /// The crossings of a block's cells and of those that touch them, by lattice edge.
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
    /// Those of a cell and of all that touch it.
    void AddAround(const LatticeIndex& cell, std::vector<SurfacePlane>& planes) const
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
  };

  /// Gives the block's cells that have a sharp edge or corner a vertex there.
  void FindSharpVertices(BlockPlace& place) const
  {
    FieldScope scope;
    CrossingGrid grid;
    for (std::size_t c = 0; c < place.block->cells.size(); ++c)
    {
      const std::size_t before = place.sharp.size();
      this->FindSharpVertex(place, c, grid, scope);
      if (place.sharp.size() == before &&
        MarchingCubesCases::Get().NeedsMiddle(place.block->cases[c], BlockMesh::JoinedFacesOf(place, c)))
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

  /// The same for one cell. The grid and the scope are the block's, made when they are first needed.
  void FindSharpVertex(
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
      this->FillGrid(place, grid);
    }
    std::vector<SurfacePlane> planes, around;
    for (int edge : loops[0])
    {
      grid.Add(
        BlockMesh::FirstPoint(BlockMesh::CellOf(block.cells[c]), edge), edge >> 2, planes);
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
    scope = scope.views.empty() && scope.planes.empty() ? this->ScopeAround(block) : scope;
    std::vector<SharpFeature> features = this->CornersNearby(cell, own);
    features.push_back(own);
    this->AddSharpVertex(place, c, features, planes, scope, true);
    for (const SharpFeature& feature : features)
    {
      this->Offer(cell, feature, place.offers);
    }
  }

  void FillGrid(const BlockPlace& place, CrossingGrid& grid) const
  {
    grid.at.fill(0);
    const int size = ContourBlock::Size;
    for (int n = 0; n < 27; ++n)
    {
      const LatticeIndex offset = { n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1 };
      const LatticeIndex& at = place.block->at;
      const BlockPlace* other =
        this->Blocks.FindPlace({ at[0] + offset[0], at[1] + offset[1], at[2] + offset[2] });
      for (std::size_t v = 0; other && v < other->block->keys.size(); ++v)
      {
        LatticeIndex point = ContourBlock::PointOf(other->block->keys[v]);
        for (int a = 0; a < 3; ++a)
        {
          point[a] += size * offset[a];
        }
        if (CrossingGrid::Has(point))
        {
          grid.crossings.push_back({ other->block->Position(this->Blocks.lattice, v),
            other->block->normals[v].cast<double>() });
          grid.at[CrossingGrid::Place(point, other->block->keys[v] % 3)] =
            static_cast<std::int32_t>(grid.crossings.size());
        }
      }
    }
  }

  /// The corners where planes of the cells beside a cell end its sharp edge.
  std::vector<SharpFeature> CornersNearby(const LatticeIndex& cell, const SharpFeature& edge) const
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

  /// A vertex at the first of the features that is in reach and in the field.
  void AddSharpVertex(BlockPlace& place, std::size_t c, std::vector<SharpFeature>& features,
    const std::vector<SurfacePlane>& planes, const FieldScope& scope, bool mayTrust) const
  {
    const LatticeIndex cell = this->Blocks.LatticeCell(*place.block, c);
    const AlignedBox3d inner = this->Blocks.CellBox(cell, -BlockMesh::SharpClearance);
    const auto isFree = [&](const Vector3d& point) { return this->Field.IsFree(point, scope); };
    // What the cell's own planes show it has, if need be at the nearest place in it.
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

  /// Moves a feature of a cell into the cell, or else into the nearest cell around it that the
  /// lattice takes for empty: a wedge may dip there without holding any of its points. An edge that
  /// comes by in none but cells of the surface is left where it is, in one of them: there the lattice
  /// may see the wedge in two pieces that hang together.
  bool Settle(const LatticeIndex& cell, SharpFeature& feature, Reach& reach) const
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

  /// The planes are a guess where the surface is rough: a place that the field contradicts is moved to
  /// where the surface is, within the cell. False where it is not found: the cell does better without.
  bool PutOnSurface(Vector3d& position, const Vector3d& up, const AlignedBox3d& inner,
    const std::function<bool(const Vector3d&)>& isFree) const
  {
    const Vector3d slack = BlockMesh::VertexSlack * this->Blocks.lattice.spacing * up;
    return (isFree(position + slack) && !isFree(position - slack)) ||
      MoveToBoundary(position, up, inner, isFree);
  }

  /// Offers a feature to the cells around that it passes: their own crossings may not show it.
  void Offer(
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

  void HandOverOffers()
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

  /// Gives cells without a sharp vertex one at a feature that they were offered, and cells with an
  /// edge a corner.
  void TakeOffers(BlockPlace& place) const
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
    const FieldScope scope = this->ScopeAround(*place.block);
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

  /// Where cells found the same corner beyond themselves, leaves it to the one that needs no planes of
  /// others, or else to the first.
  void KeepCornersApart()
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

  /// What the field leaves open where the sharp vertices of a block may lie.
  FieldScope ScopeAround(const ContourBlock& block) const
  {
    const double size = ContourBlock::Size;
    const Vector3d low = this->Blocks.CellCorner(block, { -2, -2, -2 });
    const AlignedBox3d box(
      low, low + Vector3d::Constant((size + 4) * this->Blocks.lattice.spacing));
    FieldScope scope;
    return this->Field.Classify(box, this->Field.Root(), scope) == BoxContent::Mixed
      ? scope
      : this->Field.Root();
  }

  static Vector3d Clamp(const Vector3d& point, const AlignedBox3d& box)
  {
    return point.cwiseMax(box.min()).cwiseMin(box.max());
  }

  static Vector3d MiddleOf(const std::vector<SurfacePlane>& planes)
  {
    Vector3d middle = Vector3d::Zero();
    for (const SurfacePlane& plane : planes)
    {
      middle += plane.point / static_cast<double>(planes.size());
    }
    return middle;
  }

  /// Over which normals are smoothed before they tell of sharp edges, in cells.
  static constexpr double SmoothingRadius = 1.5;

  const BoundedField& Field;
  BlockMesh& Blocks;
  const double SharpCosine, HalfSharpCosine;
};

}

void FindSharpEdges(const BoundedField& field, double sharpAngle, BlockMesh& blocks,
  const Progress& progress, const ParallelFor& parallelFor)
{
  SharpVertexFinder(field, blocks, sharpAngle).Find(progress, parallelFor);
}

}
