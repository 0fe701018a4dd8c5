// SPDX-License-Identifier: BSD-3-Clause
#include "BisectionContour.h"

#include "ContourBlock.h"
#include "ContourEstimate.h"
#include "CubeCases.h"
#include "Error.h"
#include "SharpFeature.h"
#include "TriangleIntersections.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <unordered_map>
#include <unordered_set>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace freespace
{

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

void ContourOptions::Check() const
{
  if (this->cells < 2)
  {
    throw Error(
      "The lattice has " + std::to_string(this->cells) + " cells, it must have at least 2.");
  }
  if (!(this->tolerance > 0 && this->tolerance <= 0.5))
  {
    throw Error("The tolerance of the bisection is " + std::to_string(this->tolerance) +
      " cells, it must be above 0 and at most 0.5.");
  }
  if (!(this->clearance > 0 && this->clearance <= 0.25))
  {
    throw Error("The clearance of vertices is " + std::to_string(this->clearance) +
      " cells, it must be above 0 and at most 0.25.");
  }
  if (!(this->sharpAngle > 0 && this->sharpAngle < 180))
  {
    throw Error("The sharp angle is " + std::to_string(this->sharpAngle) +
      " degrees, it must be between 0 and 180.");
  }
  if (!(this->memoryLimit >= 0))
  {
    throw Error(
      "The memory limit is " + std::to_string(this->memoryLimit) + " MiB, it must be 0 or more.");
  }
  if (this->pieces < 1 || this->piece < 0 || this->piece >= this->pieces)
  {
    throw Error("There is no piece " + std::to_string(this->piece) + " of " +
      std::to_string(this->pieces) + ".");
  }
}

bool SinglePrecisionSuffices(const AlignedBox3d& bounds, const ContourOptions& options)
{
  const double largest = bounds.min().cwiseAbs().cwiseMax(bounds.max().cwiseAbs()).maxCoeff();
  const double spacing = bounds.sizes().maxCoeff() / std::max(1, options.cells - 1);
  return largest * std::numeric_limits<float>::epsilon() < spacing * options.clearance / 16;
}

namespace
{

/// Cells along the side of a region: what one thread does at a time.
constexpr int RegionSize = 4 * ContourBlock::Size;

/// Up to so many cells, regions are few enough to be found without an estimate before.
constexpr int QuicklyDescended = 1536;

/// So much is done between two looks at the progress.
constexpr std::size_t RegionsAtATime = 16;
constexpr std::size_t RangesAtATime = 1024;
constexpr std::size_t PlacesAtATime = 2048;

/// Gives pages that hold nothing any more back to the system, where the C library does not do it by
/// itself: the mesh grows into them.
void ReturnFreeMemory()
{
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

/// A part of the lattice that the surface may pass.
struct Region
{
  CellRange range;
  FieldScope scope;
  bool isOwn; ///< of this piece; otherwise only its vertices are wanted
  int layer;
  std::vector<ContourBlock> blocks;
};

/// Which cell a sharp vertex lies in: its own, or one beside it, where triangles may be in the way.
enum class Reach
{
  Own,
  Empty,
  Surface
};

/// A vertex of a cell, about which the cell's triangles are a fan.
struct SharpVertex
{
  std::size_t cell; ///< place in the block's cells
  Vector3d position;
  Vector3d fallback; ///< within the cell
  Vector3d edge;     ///< of a corner: where it would be otherwise
  Reach edgeReach;
  bool isCorner;
  bool isBorrowed; ///< from a plane of another cell
  Reach reach;
};

/// A sharp feature that the planes of a cell show in another one.
struct SharpOffer
{
  LatticeIndex cell; ///< of the lattice; in a block's own list, of the block
  SharpFeature feature;
};

/// A cell's faces on which two corners in matter, opposite to each other, hang together.
struct JoinedFaces
{
  std::size_t cell; ///< place in the block's cells
  int faces;        ///< one bit for each
};

/// A face of a cell, over which its sharp vertex is joined to the next cell's, though not through it.
struct Bridge
{
  std::size_t cell; ///< place in the block's cells
  int face;
};

/// Where a block's vertices and triangles come in the mesh. The vertices are those of the block, then
/// the sharp ones.
struct BlockPlace
{
  const ContourBlock* block;
  bool isOwn;
  std::int32_t firstVertex;
  std::size_t firstTriangle;
  std::vector<JoinedFaces> joined; ///< in the order of their cells
  std::vector<SharpVertex> sharp;  ///< in the order of their cells
  std::vector<Bridge> bridges;
  std::vector<SharpOffer> offers;   ///< to any block's cells
  std::vector<SharpOffer> received; ///< to the block's cells
  std::vector<std::int32_t> vertex; ///< of another piece's block: place in the mesh, or -1

  std::size_t NumberOfVertices() const { return this->block->keys.size() + this->sharp.size(); }
};

std::uint64_t PlaceKey(const LatticeIndex& at)
{
  const auto bits = [](int x) { return static_cast<std::uint64_t>(x); };
  return bits(at[0]) | bits(at[1]) << 21 | bits(at[2]) << 42;
}

/// Descends the octree of boxes below a range to those of the wanted size that are mixed. Looks at
/// those only that are wanted.
template <typename Want, typename Visit>
void Descend(const BoundedField& field, const ContourLattice& lattice, const CellRange& range,
  int size, const FieldScope& parent, Want&& isWanted, Visit&& visit)
{
  FieldScope scope;
  if (!isWanted(range) || field.Classify(range.Box(lattice), parent, scope) != BoxContent::Mixed)
  {
    return;
  }
  if (range.Longest() <= size)
  {
    visit(range, scope);
    return;
  }
  for (const CellRange& part : range.Parts(size))
  {
    Descend(field, lattice, part, size, scope, isWanted, visit);
  }
}

class Contour
{
public:
  Contour(const ContourField& field, const AlignedBox3d& bounds, const ContourOptions& options)
    : Field(field, bounds)
    , Lattice(bounds, options.cells)
    , Options(options)
    , IsSingle(SinglePrecisionSuffices(bounds, options))
    , Crossing{ options.tolerance, options.clearance, options.exact, options.sharp }
    , SharpCosine(std::cos(options.sharpAngle * M_PI / 180.0))
    , HalfSharpCosine(std::cos(options.sharpAngle * M_PI / 360.0))
  {
  }

  void Run(const AllocateContour& allocate, const Progress& progress,
    const ParallelFor& parallelFor, bool isThreadSafe)
  {
    if (this->Options.cells > QuicklyDescended)
    {
      this->CheckEstimate(progress);
    }
    this->FindRegions(progress.Part(0.0, 0.05));
    this->FindBlocks(
      progress.Part(0.05, 0.8), isThreadSafe ? parallelFor : SerialFor, isThreadSafe);
    this->PlaceBlocks(progress.Part(0.8, 0.9), isThreadSafe ? parallelFor : SerialFor);
    const ContourArrays arrays = allocate({ this->Vertices, this->OwnVertices, this->Triangles });
    this->Write(arrays, progress.Part(0.9, 1.0), parallelFor);
    progress(1.0);
  }

private:
  /// Refuses surfaces that are too large, before the work.
  void CheckEstimate(const Progress& progress) const
  {
    if (this->Options.memoryLimit > 0)
    {
      const ContourEstimate estimate =
        EstimateContour(this->Field.Inner(), this->Field.Box(), this->Options, progress);
      CheckMemoryLimit(estimate.triangles / this->Options.pieces, this->Options, this->IsSingle);
    }
  }

  /// The regions of this piece, and those next to them, whose vertices its triangles need.
  void FindRegions(const Progress& progress)
  {
    const CellRange all = { { 0, 0, 0 }, this->Lattice.cells };
    std::size_t asked = 0;
    Descend(
      this->Field, this->Lattice, all, RegionSize, this->Field.Root(),
      [&](const CellRange&)
      {
        if (asked++ % RangesAtATime == 0)
        {
          progress(0.0);
        }
        return true;
      },
      [&](const CellRange& range, FieldScope& scope) {
        this->Regions.push_back({ range, std::move(scope), true, 0, {} });
      });
    // Many regions are few triangles, unless the surface is rough.
    const double worst = 5.0 * RegionSize * RegionSize * RegionSize * this->Regions.size();
    if (this->Options.cells <= QuicklyDescended &&
      ContourMegabytes(worst, this->Options, this->IsSingle) > this->Options.memoryLimit)
    {
      this->CheckEstimate(progress);
    }
    // Layer by layer along the longest side, so that what was written can soon be let go.
    const auto& cells = this->Lattice.cells;
    const auto height = [axis = std::max_element(cells.begin(), cells.end()) - cells.begin()](
                          const Region& region) { return region.range.low[axis] / RegionSize; };
    std::stable_sort(this->Regions.begin(), this->Regions.end(),
      [&](const Region& a, const Region& b) { return height(a) < height(b); });
    for (Region& region : this->Regions)
    {
      region.layer = height(region);
    }
    if (this->Options.pieces > 1)
    {
      this->KeepPiece();
    }
  }

  void KeepPiece()
  {
    const std::size_t count = this->Regions.size(), pieces = this->Options.pieces;
    for (std::size_t i = 0; i < count; ++i)
    {
      Region& region = this->Regions[i];
      region.isOwn = i * pieces / count == static_cast<std::size_t>(this->Options.piece);
      if (region.isOwn)
      {
        this->OwnRegions.insert(PlaceKey(region.range.low));
      }
    }
    const auto isAway = [this](const Region& region)
    { return !region.isOwn && !this->IsBesideOwn(region.range.low, RegionSize); };
    this->Regions.erase(
      std::remove_if(this->Regions.begin(), this->Regions.end(), isAway), this->Regions.end());
  }

  /// Whether a box of cells touches a region of this piece such that this needs vertices of it.
  bool IsBesideOwn(const LatticeIndex& low, int size) const
  {
    // Triangles have corners in boxes above their own; to sharp vertices they also reach below.
    const int above = this->Options.sharp ? 1 : 0;
    for (int k = -1; k <= above; ++k)
    {
      for (int j = -1; j <= above; ++j)
      {
        for (int i = -1; i <= above; ++i)
        {
          const LatticeIndex other = { low[0] + i * size, low[1] + j * size, low[2] + k * size };
          if (std::min({ other[0], other[1], other[2] }) >= 0 &&
            this->OwnRegions.count(PlaceKey({ other[0] / RegionSize * RegionSize,
              other[1] / RegionSize * RegionSize, other[2] / RegionSize * RegionSize })))
          {
            return true;
          }
        }
      }
    }
    return false;
  }

  void FindBlocks(const Progress& progress, const ParallelFor& parallelFor, bool isThreadSafe)
  {
    const std::size_t portion = isThreadSafe ? RegionsAtATime : 1;
    const std::size_t count = this->Regions.size();
    double found = 0.0; // triangles: two to a vertex
    for (std::size_t done = 0; done < count; done += portion)
    {
      const double fraction = static_cast<double>(done) / count;
      progress(fraction);
      parallelFor(std::min(portion, count - done),
        [&](std::size_t begin, std::size_t end)
        {
          for (std::size_t i = done + begin; i < done + end; ++i)
          {
            // Only the caller's thread may look at the progress.
            this->RunRegion(this->Regions[i], isThreadSafe ? Progress() : progress, fraction);
          }
        });
      for (std::size_t i = done; i < std::min(done + portion, count); ++i)
      {
        for (const ContourBlock& block : this->Regions[i].blocks)
        {
          found += this->Regions[i].isOwn ? 2.0 * block.keys.size() : 0.0;
        }
      }
      CheckMemoryLimit(found, this->Options, this->IsSingle);
    }
    progress(1.0);
  }

  void RunRegion(Region& region, const Progress& progress, double fraction) const
  {
    Descend(
      this->Field, this->Lattice, region.range, ContourBlock::Size, region.scope,
      [&](const CellRange& range)
      {
        return region.isOwn || range.Longest() > ContourBlock::Size ||
          this->IsBesideOwn(range.low, ContourBlock::Size);
      },
      [&](const CellRange& range, const FieldScope& scope)
      {
        progress(fraction);
        ContourBlock block(this->Field, this->Lattice, this->Crossing, range, scope);
        if (!block.keys.empty() || !block.cells.empty())
        {
          region.blocks.push_back(std::move(block));
        }
      });
    region.blocks.shrink_to_fit();
    region.scope = {};
  }

  void PlaceBlocks(const Progress& progress, const ParallelFor& parallelFor)
  {
    std::size_t count = 0;
    for (const Region& region : this->Regions)
    {
      count += region.blocks.size();
    }
    this->Places.reserve(count);
    this->Index.reserve(count);
    for (std::size_t r = 0; r < this->Regions.size(); ++r)
    {
      const Region& region = this->Regions[r];
      if (r == 0 || region.layer != this->Regions[r - 1].layer)
      {
        this->Layers.push_back({ r, this->Places.size() });
      }
      for (const ContourBlock& block : region.blocks)
      {
        this->Index[PlaceKey(block.at)] = this->Places.size();
        this->Places.push_back({ &block, region.isOwn, 0, 0, {}, {}, {}, {}, {}, {} });
      }
    }
    this->Layers.push_back({ this->Regions.size(), this->Places.size() });
    if (this->Options.sharp)
    {
      this->FindSharpEdges(progress, parallelFor);
    }
    for (BlockPlace& place : this->Places)
    {
      place.firstVertex = static_cast<std::int32_t>(this->Vertices);
      place.firstTriangle = this->Triangles;
      if (place.isOwn)
      {
        // A fan about a vertex of its own has two triangles more.
        this->Vertices += place.NumberOfVertices();
        this->Triangles += place.block->NumberOfTriangles() + 2 * place.sharp.size();
        for (const JoinedFaces& joined : place.joined)
        {
          const int matter = place.block->cases[joined.cell];
          this->Triangles += CubeCases::Get().NumberOfTriangles(matter, joined.faces) -
            CubeCases::Get().NumberOfTriangles(matter);
        }
      }
      this->CheckSize();
    }
    this->OwnVertices = this->Vertices;
    for (std::size_t i = 0; i < this->Places.size() && this->Options.pieces > 1; ++i)
    {
      this->CountForeign(this->Places[i]);
    }
  }

  /// Calls work(place) for all places, in parallel, with looks at the progress in between.
  template <typename Work>
  void ForEachPlace(const Progress& progress, const ParallelFor& parallelFor, Work&& work,
    const std::function<void(std::size_t layer)>& afterLayer = {}) const
  {
    const std::size_t count = this->Places.size();
    for (std::size_t layer = 0; layer + 1 < this->Layers.size(); ++layer)
    {
      const std::size_t end = this->Layers[layer + 1].place;
      for (std::size_t first = this->Layers[layer].place; first < end; first += PlacesAtATime)
      {
        progress(static_cast<double>(first) / count);
        parallelFor(std::min(PlacesAtATime, end - first),
          [&](std::size_t from, std::size_t to)
          {
            for (std::size_t i = first + from; i < first + to; ++i)
            {
              work(i);
            }
          });
      }
      if (afterLayer)
      {
        afterLayer(layer);
      }
    }
  }

  /// Gives cells that sharp edges and corners pass a vertex there, and decides which of the vertices
  /// are joined.
  void FindSharpEdges(const Progress& progress, const ParallelFor& parallelFor)
  {
    this->ForEachPlace(progress.Part(0.0, 0.1), parallelFor,
      [this](std::size_t i) { this->JoinFaces(this->Places[i]); });
    this->ForEachPlace(progress.Part(0.1, 0.5), parallelFor,
      [this](std::size_t i) { this->FindSharpVertices(this->Places[i]); });
    this->HandOverOffers();
    this->ForEachPlace(progress.Part(0.5, 0.6), parallelFor,
      [this](std::size_t i) { this->TakeOffers(this->Places[i]); });
    this->KeepCornersApart();
    this->MoveMeetingVerticesBack(progress.Part(0.6, 0.8), parallelFor);
    this->FindBridges(progress.Part(0.8, 1.0), parallelFor);
  }

  /// Joins the matter across faces that a wedge passes along their diagonal. The lattice alone parts
  /// it there; the field knows better. Both cells of a face come to the same answer.
  void JoinFaces(BlockPlace& place) const
  {
    const ContourBlock& block = *place.block;
    FieldScope scope;
    for (std::size_t c = 0; c < block.cells.size(); ++c)
    {
      if (CubeCases::AmbiguousFaces(block.cases[c]) == 0)
      {
        continue;
      }
      scope = scope.views.empty() && scope.planes.empty() ? this->ScopeAround(block) : scope;
      const LatticeIndex cell = this->LatticeCell(block, c);
      const int wanted = this->FacesToJoin(cell, block.cases[c], scope);
      int joined = 0;
      for (int face = 0; face < 6; ++face)
      {
        if (wanted >> face & 1)
        {
          LatticeIndex beside = cell;
          beside[face >> 1] += (face & 1) ? 1 : -1;
          const int others = this->FacesToJoin(beside, this->CaseOf(beside), scope);
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
    int faces = CubeCases::AmbiguousFaces(matter);
    for (int face = 0; face < 6; ++face)
    {
      if (faces >> face & 1)
      {
        LatticeIndex low = cell;
        low[face >> 1] += face & 1;
        Vector3d middle = this->Lattice.Point(low[0], low[1], low[2]);
        middle += 0.5 * this->Lattice.spacing * (Vector3d::Ones() - Vector3d::Unit(face >> 1));
        faces ^= this->Field.IsFree(middle, scope) << face;
      }
    }
    return CubeCases::Get().CanJoin(matter, faces) ? faces : 0;
  }

  static int JoinedFacesOf(const BlockPlace& place, std::size_t c)
  {
    const auto joined = std::lower_bound(place.joined.begin(), place.joined.end(), c,
      [](const JoinedFaces& a, std::size_t cell) { return a.cell < cell; });
    return joined != place.joined.end() && joined->cell == c ? joined->faces : 0;
  }

  static const std::vector<CubeCases::Loop>& LoopsOf(const BlockPlace& place, std::size_t c)
  {
    return CubeCases::Get().Loops(place.block->cases[c], JoinedFacesOf(place, c));
  }

  /// Where cells found the same corner beyond themselves, leaves it to the one that needs no planes of
  /// others, or else to the first.
  void KeepCornersApart()
  {
    std::vector<SharpVertex*> corners;
    for (BlockPlace& place : this->Places)
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
    const double reach = FeatureReach * this->Lattice.spacing;
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
        CubeCases::Get().NeedsMiddle(place.block->cases[c], JoinedFacesOf(place, c)))
      {
        const LatticeIndex cell = this->LatticeCell(*place.block, c);
        std::vector<SurfacePlane> planes;
        const Vector3d middle = this->CollectPlanes(cell, planes)
          ? Clamp(MiddleOf(planes), this->CellBox(cell, -SharpClearance))
          : Vector3d(this->CellBox(cell, 0.0).center());
        place.sharp.push_back({ c, middle, middle, middle, Reach::Own, false, false, Reach::Own });
      }
    }
  }

  /// The same for one cell. The grid and the scope are the block's, made when they are first needed.
  void FindSharpVertex(
    BlockPlace& place, std::size_t c, CrossingGrid& grid, FieldScope& scope) const
  {
    const ContourBlock& block = *place.block;
    const auto& loops = LoopsOf(place, c);
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
      grid.Add(FirstPoint(CellOf(block.cells[c]), edge), edge >> 2, planes);
    }
    if (planes.size() != loops[0].size() || !NormalsDiffer(planes, this->HalfSharpCosine))
    {
      return; // most cells
    }
    grid.AddAround(CellOf(block.cells[c]), around);
    SmoothNormals(planes, around, SmoothingRadius * this->Lattice.spacing);
    SharpFeature own;
    if (!FindSharpFeature(planes, this->SharpCosine, own))
    {
      return;
    }
    const LatticeIndex cell = this->LatticeCell(block, c);
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
        this->FindPlace({ at[0] + offset[0], at[1] + offset[1], at[2] + offset[2] });
      for (std::size_t v = 0; other && v < other->block->keys.size(); ++v)
      {
        LatticeIndex point = ContourBlock::PointOf(other->block->keys[v]);
        for (int a = 0; a < 3; ++a)
        {
          point[a] += size * offset[a];
        }
        if (CrossingGrid::Has(point))
        {
          grid.crossings.push_back(
            { other->block->Position(this->Lattice, v), other->block->normals[v].cast<double>() });
          grid.at[CrossingGrid::Place(point, other->block->keys[v] % 3)] =
            static_cast<std::int32_t>(grid.crossings.size());
        }
      }
    }
  }

  /// A vertex at the first of the features that is in reach and in the field.
  void AddSharpVertex(BlockPlace& place, std::size_t c, std::vector<SharpFeature>& features,
    const std::vector<SurfacePlane>& planes, const FieldScope& scope, bool mayTrust) const
  {
    const LatticeIndex cell = this->LatticeCell(*place.block, c);
    const AlignedBox3d inner = this->CellBox(cell, -SharpClearance);
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
      if (!isTrusted && !feature.IsConfirmed(FeatureReach * this->Lattice.spacing, isFree))
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

  /// The planes are a guess where the surface is rough: a place that the field contradicts is moved to
  /// where the surface is, within the cell. False where it is not found: the cell does better without.
  bool PutOnSurface(Vector3d& position, const Vector3d& up, const AlignedBox3d& inner,
    const std::function<bool(const Vector3d&)>& isFree) const
  {
    const Vector3d slack = VertexSlack * this->Lattice.spacing * up;
    return (isFree(position + slack) && !isFree(position - slack)) ||
      MoveToBoundary(position, up, inner, isFree);
  }

  /// Offers a feature to the cells around that it passes: their own crossings may not show it.
  void Offer(
    const LatticeIndex& cell, const SharpFeature& feature, std::vector<SharpOffer>& offers) const
  {
    for (int n = 0; n < 27; ++n)
    {
      const LatticeIndex beside = Beside(cell, n);
      SharpFeature moved = feature;
      if (beside != cell && moved.SlideInto(this->CellBox(beside, SharpClearance)) &&
        this->CaseOf(beside) != 0)
      {
        offers.push_back({ beside, feature });
      }
    }
  }

  static LatticeIndex Beside(const LatticeIndex& cell, int n)
  {
    return { cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1 };
  }

  void HandOverOffers()
  {
    for (BlockPlace& place : this->Places)
    {
      for (SharpOffer& offer : place.offers)
      {
        const BlockPlace* receiver = this->PlaceOf(offer.cell);
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
      const LatticeIndex cell = this->LatticeCell(*place.block, c);
      if (!features.empty() && this->CollectPlanes(cell, planes))
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

  /// What the field leaves open where the sharp vertices of a block may lie.
  FieldScope ScopeAround(const ContourBlock& block) const
  {
    const double size = ContourBlock::Size;
    const Vector3d low = this->CellCorner(block, { -2, -2, -2 });
    const AlignedBox3d box(low, low + Vector3d::Constant((size + 4) * this->Lattice.spacing));
    FieldScope scope;
    return this->Field.Classify(box, this->Field.Root(), scope) == BoxContent::Mixed
      ? scope
      : this->Field.Root();
  }

  LatticeIndex LatticeCell(const ContourBlock& block, std::size_t c) const
  {
    LatticeIndex cell = CellOf(block.cells[c]);
    for (int axis = 0; axis < 3; ++axis)
    {
      cell[axis] += ContourBlock::Size * block.at[axis];
    }
    return cell;
  }

  /// The block that a cell or point of the lattice belongs to; null: the surface is not near. Makes
  /// the index one in the block.
  const BlockPlace* PlaceOf(LatticeIndex& index) const
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
    const auto place = this->Index.find(PlaceKey(at));
    return place == this->Index.end() ? nullptr : &this->Places[place->second];
  }

  /// Finds a cell of the lattice in its block. False where the surface does not pass.
  bool FindCell(LatticeIndex cell, const BlockPlace*& place, std::size_t& c) const
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

  /// The case of a cell of the lattice; 0 where the surface does not pass.
  int CaseOf(const LatticeIndex& cell) const
  {
    const BlockPlace* place = nullptr;
    std::size_t c = 0;
    return this->FindCell(cell, place, c) ? place->block->cases[c] : 0;
  }

  /// The planes of the surface in a cell of the lattice. False when they are not of one sheet.
  bool CollectPlanes(const LatticeIndex& cell, std::vector<SurfacePlane>& planes) const
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
      planes.push_back({ owner->block->Position(this->Lattice, vertex),
        owner->block->normals[vertex].cast<double>() });
    }
    return true;
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
      this->CollectPlanes(beside, planes);
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

  /// A cell of the lattice with (positive) or without (negative) a rim, in cells.
  AlignedBox3d CellBox(const LatticeIndex& cell, double rim) const
  {
    const Vector3d low = this->Lattice.Point(cell[0], cell[1], cell[2]);
    const double room = rim * this->Lattice.spacing;
    return { low - Vector3d::Constant(room),
      low + Vector3d::Constant(this->Lattice.spacing + room) };
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

  /// Moves a feature of a cell into the cell, or else into the nearest cell around it that the
  /// lattice takes for empty: a wedge may dip there without holding any of its points. An edge that
  /// comes by in none but cells of the surface is left where it is, in one of them: there the lattice
  /// may see the wedge in two pieces that hang together.
  bool Settle(const LatticeIndex& cell, SharpFeature& feature, Reach& reach) const
  {
    reach = Reach::Own;
    if (feature.SlideInto(this->CellBox(cell, -SharpClearance)) ||
      feature.SlideInto(this->CellBox(cell, SharpClearance)))
    {
      return true;
    }
    double least = HUGE_VAL;
    SharpFeature nearest = feature;
    for (int n = 0; n < 27; ++n)
    {
      const LatticeIndex beside = Beside(cell, n);
      SharpFeature moved = feature;
      if (moved.SlideInto(this->CellBox(beside, 0.0)) &&
        (moved.position - feature.position).norm() < least && this->CaseOf(beside) == 0)
      {
        least = (moved.position - feature.position).norm();
        nearest = moved;
      }
    }
    feature = nearest;
    reach = least < HUGE_VAL ? Reach::Empty : Reach::Surface;
    return reach == Reach::Empty ||
      (!feature.IsCorner() && this->CellBox(cell, 1.0).contains(feature.position));
  }

  static LatticeIndex CellOf(int cell)
  {
    const int size = ContourBlock::Size;
    return { cell % size, cell / size % size, cell / (size * size) };
  }

  static LatticeIndex FirstPoint(const LatticeIndex& cell, int edge)
  {
    const int begin = CubeCases::Begin(edge);
    return { cell[0] + (begin & 1), cell[1] + (begin >> 1 & 1), cell[2] + (begin >> 2 & 1) };
  }

  Vector3d CellCorner(const ContourBlock& block, const LatticeIndex& cell) const
  {
    const int size = ContourBlock::Size;
    return this->Lattice.Point(
      size * block.at[0] + cell[0], size * block.at[1] + cell[1], size * block.at[2] + cell[2]);
  }

  void CheckSize() const
  {
    if (this->Vertices > INT32_MAX || 3 * this->Triangles > INT32_MAX)
    {
      throw Error("The surface has more than 2^31 corners, use fewer cells or more pieces.");
    }
  }

  /// Gives the vertices of other pieces that a block's triangles use their places.
  void CountForeign(const BlockPlace& own)
  {
    if (!own.isOwn)
    {
      return;
    }
    this->ForEachTriangle(own,
      [&](std::size_t, const std::array<Vertex, 3>& corners, bool, int)
      {
        for (const Vertex& corner : corners)
        {
          BlockPlace& owner = *corner.owner;
          if (!owner.isOwn)
          {
            owner.vertex.resize(owner.NumberOfVertices(), -1);
            if (owner.vertex[corner.vertex] < 0)
            {
              owner.vertex[corner.vertex] = static_cast<std::int32_t>(this->Vertices++);
              this->CheckSize();
            }
          }
        }
      });
  }

  /// A vertex: of which block, and its place in it.
  struct Vertex
  {
    BlockPlace* owner;
    std::size_t vertex;
  };

  /// Calls visit(triangle, its three corners, whether it is in the fan about a sharp vertex, the face
  /// that its two last corners share) for all triangles of a block. In a fan, the sharp vertex is the first corner. False when a vertex is not
  /// there.
  template <typename Visit>
  bool ForEachTriangle(const BlockPlace& place, Visit&& visit) const
  {
    const ContourBlock& block = *place.block;
    std::size_t triangle = 0, sharp = 0;
    bool whole = true;
    Neighbors neighbors = {};
    for (std::size_t c = 0; c < block.cells.size(); ++c)
    {
      const LatticeIndex cell = CellOf(block.cells[c]);
      const bool isSharp = sharp < place.sharp.size() && place.sharp[sharp].cell == c;
      for (const CubeCases::Loop& loop : LoopsOf(place, c))
      {
        const std::size_t size = loop.size();
        for (std::size_t n = isSharp ? 0 : 2; n < size; ++n, ++triangle)
        {
          const int from = loop[n > 0 ? n - 1 : size - 1], to = loop[n];
          std::array<Vertex, 3> corners;
          if (isSharp)
          {
            corners[0] = { const_cast<BlockPlace*>(&place), block.keys.size() + sharp };
          }
          if ((!isSharp && !this->FindCorner(place, cell, loop[0], neighbors, corners[0])) ||
            !this->FindCorner(place, cell, from, neighbors, corners[1]) ||
            !this->FindCorner(place, cell, to, neighbors, corners[2]))
          {
            whole = false;
            continue;
          }
          if (isSharp)
          {
            this->JoinSharp(place, sharp, CubeCases::CommonFace(from, to), corners[2]);
          }
          visit(triangle, corners, isSharp, CubeCases::CommonFace(from, to));
        }
      }
      sharp += isSharp;
    }
    return whole;
  }

  /// The blocks above a block, as far as they were looked for.
  using Neighbors = std::array<BlockPlace*, 8>;

  /// The vertex on a cube edge of a cell.
  bool FindCorner(const BlockPlace& place, const LatticeIndex& cell, int edge, Neighbors& neighbors,
    Vertex& corner) const
  {
    const int size = ContourBlock::Size;
    const LatticeIndex point = FirstPoint(cell, edge);
    BlockPlace*& owner = neighbors[point[0] / size | point[1] / size << 1 | point[2] / size << 2];
    corner.vertex = this->FindVertex(place, point, edge >> 2, owner);
    corner.owner = owner;
    return corner.vertex != Missing;
  }

  static constexpr std::size_t Missing = static_cast<std::size_t>(-1);

  BlockPlace* FindPlace(const LatticeIndex& at) const
  {
    const auto place = this->Index.find(PlaceKey(at));
    return place == this->Index.end() ? nullptr
                                      : const_cast<BlockPlace*>(&this->Places[place->second]);
  }

  /// The vertex on a lattice edge, in the block that owns it.
  std::size_t FindVertex(
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

  /// The vertex on the lattice edge from a point of a block.
  static std::size_t VertexAt(const ContourBlock& block, const LatticeIndex& point, int axis)
  {
    const auto& keys = block.keys;
    const auto key = std::lower_bound(keys.begin(), keys.end(), ContourBlock::Key(point, axis));
    return key != keys.end() && *key == ContourBlock::Key(point, axis) ? key - keys.begin()
                                                                       : Missing;
  }

  /// A face of a cell with a sharp vertex, beyond which there is another one.
  struct SharpFace
  {
    Vertex other;
    bool isUpper; ///< of the cell
    int axis;
    Vector3d low; ///< the face's first corner
  };

  /// False when there is no other sharp vertex, or more than one line crosses the face.
  bool FindSharpFace(
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
    return !CubeCases::IsAmbiguous(place.block->cases[own.cell], face) &&
      this->FindSharp(place, other, sharpFace.other);
  }

  static SharpVertex& SharpOf(const Vertex& vertex)
  {
    return vertex.owner->sharp[vertex.vertex - vertex.owner->block->keys.size()];
  }

  /// Two triangles meet on the face between two cells with sharp vertices s and t: (s, u, v) and
  /// (t, v, u). To join s and t by an edge, instead of the one that parts them, they become (s, u, t)
  /// and (t, v, s): the last corner of each changes. Both cells decide alike.
  void JoinSharp(const BlockPlace& place, std::size_t sharp, int face, Vertex& last) const
  {
    const SharpVertex& own = place.sharp[sharp];
    SharpFace sharpFace;
    if (this->FindSharpFace(place, sharp, face, sharpFace))
    {
      const SharpVertex& other = SharpOf(sharpFace.other);
      const bool isBridged = std::any_of(place.bridges.begin(), place.bridges.end(),
        [&](const Bridge& bridge) { return bridge.cell == own.cell && bridge.face == face; });
      const bool areOwn = own.reach == Reach::Own && other.reach == Reach::Own;
      if (isBridged || (areOwn && this->IsThroughFace(own.position, other.position, sharpFace)))
      {
        last = sharpFace.other;
      }
    }
  }

  /// The sharp vertex of a cell of the block or next to it.
  bool FindSharp(const BlockPlace& from, LatticeIndex cell, Vertex& found) const
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

  /// Whether an edge between two sharp vertices passes through the face between their cells, well off
  /// its border: then the new triangles stay within the two cells, where nothing else is on that face.
  bool IsThroughFace(const Vector3d& own, const Vector3d& other, const SharpFace& face) const
  {
    const Vector3d &lower = face.isUpper ? own : other, &upper = face.isUpper ? other : own;
    const int axis = face.axis;
    const double from = lower[axis] - face.low[axis], to = upper[axis] - face.low[axis];
    const Vector3d through = lower + from / (from - to) * (upper - lower);
    const double room = SharpClearance * this->Lattice.spacing;
    bool isInside = from * to < 0;
    for (int across : { (axis + 1) % 3, (axis + 2) % 3 })
    {
      const double place = through[across] - face.low[across];
      isInside = isInside && place > room && place < this->Lattice.spacing - room;
    }
    return isInside;
  }

  SurfacePlane PlaneAt(const Vertex& vertex) const
  {
    return { vertex.owner->block->Position(this->Lattice, vertex.vertex),
      vertex.owner->block->normals[vertex.vertex].cast<double>() };
  }

  /// Whether an edge between two sharp vertices s and t, in place of the one from u to v, lies in the
  /// planes at both, and the triangles (s, u, t) and (t, v, s) look to their free sides.
  bool IsOnSurface(const Vector3d& s, const Vector3d& t, const Vertex& u, const Vertex& v) const
  {
    const double reach = FeatureReach * this->Lattice.spacing;
    const auto isIn = [&](const SurfacePlane& plane, double side)
    {
      const Vector3d turned = side * (t - s).cross(plane.point - s);
      return std::abs(plane.normal.dot(s - plane.point)) <= reach &&
        std::abs(plane.normal.dot(t - plane.point)) <= reach && turned.dot(plane.normal) > 0;
    };
    return isIn(this->PlaneAt(u), -1.0) && isIn(this->PlaneAt(v), 1.0);
  }

  /// Triangles that the mesh may have near some choices, of which it has those whose conditions hold.
  struct Candidates
  {
    static constexpr int Always = -1;
    static int If(int choice) { return 2 * choice + 1; }
    static int IfNot(int choice) { return 2 * choice; }

    std::vector<std::int32_t> triangles;
    std::vector<std::array<int, 2>> conditions; ///< per triangle
    std::vector<Vector3d> points;
    /// The same; in memory, since GCC 12 leaves out a conversion to single precision and back.
    std::vector<Eigen::Vector3f> rounded;
    std::unordered_map<std::uint64_t, std::int32_t> ids;
  };

  /// A sharp vertex where it may be.
  struct MaybeVertex
  {
    Vertex vertex;
    Vector3d position;
    bool isOwn; ///< in its own cell
    int condition;
  };

  /// What is to be chosen, and how much it matters that it is chosen: the greater rank gives way.
  struct Choice
  {
    Vertex vertex;
    int face; ///< of a bridge
    std::array<double, 4> rank;
    bool isLost;
  };

  std::uint64_t KeyOf(const Vertex& vertex) const
  {
    return static_cast<std::uint64_t>(vertex.owner - this->Places.data()) << 16 |
      static_cast<std::uint64_t>(vertex.vertex) << 1;
  }

  std::int32_t AddPoint(Candidates& candidates, std::uint64_t key, const Vector3d& position) const
  {
    const auto [place, isNew] =
      candidates.ids.emplace(key, static_cast<std::int32_t>(candidates.points.size()));
    if (isNew)
    {
      candidates.points.push_back(position);
      candidates.rounded.push_back(position.cast<float>());
    }
    return place->second;
  }

  std::int32_t AddCorner(Candidates& candidates, const Vertex& vertex) const
  {
    return this->AddPoint(
      candidates, this->KeyOf(vertex), vertex.owner->block->Position(this->Lattice, vertex.vertex));
  }

  std::int32_t AddCorner(Candidates& candidates, const MaybeVertex& vertex) const
  {
    const bool isBack = vertex.condition >= 0 && vertex.condition % 2 == 0;
    return this->AddPoint(candidates, this->KeyOf(vertex.vertex) + isBack, vertex.position);
  }

  static void AddTriangle(Candidates& candidates, const std::array<std::int32_t, 3>& corners,
    int conditionA, int conditionB = Candidates::Always)
  {
    candidates.triangles.insert(candidates.triangles.end(), corners.begin(), corners.end());
    candidates.conditions.push_back({ conditionA, conditionB });
  }

  /// All that may become of a sharp vertex, while it is not decided which vertices stay beyond their
  /// cells.
  using ChoiceIndex = std::unordered_map<std::uint64_t, int>;
  std::vector<MaybeVertex> Maybe(const Vertex& vertex, const ChoiceIndex& choices) const
  {
    const SharpVertex& sharp = SharpOf(vertex);
    const auto choice = choices.find(this->KeyOf(vertex));
    if (choice == choices.end())
    {
      return { { vertex, sharp.position, sharp.reach == Reach::Own, Candidates::Always } };
    }
    return { { vertex, sharp.position, false, Candidates::If(choice->second) },
      { vertex, sharp.fallback, true, Candidates::IfNot(choice->second) } };
  }

  /// Adds a block's triangles. The choices are vertices that reach beyond their cells, or (with the
  /// face added to their key) bridges.
  void AddCandidates(
    const BlockPlace& place, const ChoiceIndex& choices, Candidates& candidates) const
  {
    std::size_t sharp = 0;
    Neighbors neighbors = {};
    for (std::size_t c = 0; c < place.block->cells.size(); ++c)
    {
      const LatticeIndex cell = CellOf(place.block->cells[c]);
      const bool isSharp = sharp < place.sharp.size() && place.sharp[sharp].cell == c;
      for (const CubeCases::Loop& loop : LoopsOf(place, c))
      {
        std::vector<Vertex> corners(loop.size());
        const bool isWhole = std::equal(loop.begin(), loop.end(), corners.begin(),
          [&](int edge, Vertex& corner)
          { return this->FindCorner(place, cell, edge, neighbors, corner); });
        for (std::size_t n = isSharp ? 0 : 2; n < loop.size() && isWhole; ++n)
        {
          const std::size_t from = n > 0 ? n - 1 : loop.size() - 1;
          if (isSharp)
          {
            const int face = CubeCases::CommonFace(loop[from], loop[n]);
            this->AddFanTriangle(
              place, sharp, face, corners[from], corners[n], choices, candidates);
          }
          else
          {
            AddTriangle(candidates,
              { this->AddCorner(candidates, corners[0]), this->AddCorner(candidates, corners[from]),
                this->AddCorner(candidates, corners[n]) },
              Candidates::Always);
          }
        }
      }
      sharp += isSharp;
    }
  }

  void AddFanTriangle(const BlockPlace& place, std::size_t sharp, int face, const Vertex& u,
    const Vertex& v, const ChoiceIndex& choices, Candidates& candidates) const
  {
    const Vertex own = { const_cast<BlockPlace*>(&place), place.block->keys.size() + sharp };
    SharpFace sharpFace;
    const bool hasOther = this->FindSharpFace(place, sharp, face, sharpFace);
    const std::int32_t cornerU = this->AddCorner(candidates, u);
    const std::int32_t cornerV = this->AddCorner(candidates, v);
    for (const MaybeVertex& a : this->Maybe(own, choices))
    {
      const std::int32_t cornerA = this->AddCorner(candidates, a);
      if (!hasOther)
      {
        AddTriangle(candidates, { cornerA, cornerU, cornerV }, a.condition);
        continue;
      }
      for (const MaybeVertex& b : this->Maybe(sharpFace.other, choices))
      {
        const bool isThrough =
          a.isOwn && b.isOwn && this->IsThroughFace(a.position, b.position, sharpFace);
        const auto bridge =
          choices.find(this->BridgeKey(sharpFace.isUpper ? own : sharpFace.other, face));
        const std::int32_t cornerB = this->AddCorner(candidates, b);
        if (bridge != choices.end())
        {
          AddTriangle(candidates, { cornerA, cornerU, cornerV }, Candidates::IfNot(bridge->second));
          AddTriangle(candidates, { cornerA, cornerU, cornerB }, Candidates::If(bridge->second));
        }
        else
        {
          AddTriangle(candidates, { cornerA, cornerU, isThrough ? cornerB : cornerV }, a.condition,
            b.condition);
        }
      }
    }
  }

  /// Of the bridge over the upper face of a sharp vertex's cell along the face's axis.
  std::uint64_t BridgeKey(const Vertex& lower, int face) const
  {
    return this->KeyOf(lower) | static_cast<std::uint64_t>(1 + (face >> 1)) << 60;
  }

  /// Finds the choices that cannot be made: wherever two candidate triangles meet that may be there
  /// together, the choice of the greatest rank that either needs is lost. So whatever is left can be
  /// chosen at once, and each choice depends on its surroundings only.
  void FindLostChoices(std::vector<Choice>& choices, const ChoiceIndex& index,
    const Progress& progress, const ParallelFor& parallelFor) const
  {
    for (std::size_t layer = 0; layer + 1 < this->Layers.size(); ++layer)
    {
      progress(static_cast<double>(layer) / this->Layers.size());
      const std::set<std::size_t> places = this->PlacesAround(choices, layer);
      Candidates candidates;
      for (std::size_t place : places)
      {
        this->AddCandidates(this->Places[place], index, candidates);
      }
      std::vector<std::size_t> suspects;
      for (std::size_t t = 0; t < candidates.conditions.size(); ++t)
      {
        for (int condition : candidates.conditions[t])
        {
          if (condition >= 0 && condition % 2 == 1 &&
            this->IsInLayer(choices[condition / 2].vertex, layer) &&
            (suspects.empty() || suspects.back() != t))
          {
            suspects.push_back(t);
          }
        }
      }
      const auto position = [&](std::int32_t vertex) -> Vector3d
      {
        return this->IsSingle ? Vector3d(candidates.rounded[vertex].cast<double>())
                              : candidates.points[vertex];
      };
      const TriangleSoup soup = { position, candidates.triangles.data(),
        candidates.conditions.size() };
      const auto mayMeet = [&](std::size_t a, std::size_t b)
      { return AreCompatible(candidates.conditions[a], candidates.conditions[b]); };
      for (const auto& [a, b] :
        FindIntersections(soup, suspects, this->Lattice.spacing, mayMeet, parallelFor))
      {
        Choice* loser = nullptr;
        for (std::size_t t : { a, b })
        {
          for (int condition : candidates.conditions[t])
          {
            Choice* choice =
              condition >= 0 && condition % 2 == 1 ? &choices[condition / 2] : nullptr;
            loser = choice && (!loser || loser->rank < choice->rank) ? choice : loser;
          }
        }
        if (this->IsInLayer(loser->vertex, layer))
        {
          loser->isLost = true;
        }
      }
    }
    progress(1.0);
  }

  static bool AreCompatible(const std::array<int, 2>& a, const std::array<int, 2>& b)
  {
    for (int conditionA : a)
    {
      for (int conditionB : b)
      {
        if (conditionA >= 0 && conditionB >= 0 && (conditionA ^ 1) == conditionB)
        {
          return false;
        }
      }
    }
    return true;
  }

  bool IsInLayer(const Vertex& vertex, std::size_t layer) const
  {
    const std::size_t place = vertex.owner - this->Places.data();
    return place >= this->Layers[layer].place && place < this->Layers[layer + 1].place;
  }

  /// The blocks near the choices of a layer, some cells around.
  std::set<std::size_t> PlacesAround(const std::vector<Choice>& choices, std::size_t layer) const
  {
    std::set<std::size_t> places;
    for (const Choice& choice : choices)
    {
      if (!this->IsInLayer(choice.vertex, layer))
      {
        continue;
      }
      const LatticeIndex cell =
        this->LatticeCell(*choice.vertex.owner->block, SharpOf(choice.vertex).cell);
      for (int n = 0; n < 8; ++n)
      {
        LatticeIndex at;
        for (int axis = 0; axis < 3; ++axis)
        {
          const int around =
            cell[axis] + ((n >> axis & 1) ? ContourBlock::Size / 2 : -ContourBlock::Size / 2);
          at[axis] = around < 0 ? -1 : around / ContourBlock::Size;
        }
        const BlockPlace* place =
          std::min({ at[0], at[1], at[2] }) < 0 ? nullptr : this->FindPlace(at);
        if (place)
        {
          places.insert(place - this->Places.data());
        }
      }
    }
    return places;
  }

  std::array<double, 4> RankOf(const Vertex& vertex, double first) const
  {
    const LatticeIndex cell = this->LatticeCell(*vertex.owner->block, SharpOf(vertex).cell);
    return { first, double(cell[0]), double(cell[1]), double(cell[2]) };
  }

  /// Calls visit(vertex) for all sharp vertices.
  template <typename Visit>
  void ForEachSharpVertex(Visit&& visit)
  {
    for (BlockPlace& place : this->Places)
    {
      for (std::size_t i = 0; i < place.sharp.size(); ++i)
      {
        visit(Vertex{ &place, place.block->keys.size() + i });
      }
    }
  }

  /// Of the vertices beyond their cells, leaves those about which the fans meet nothing.
  void MoveMeetingVerticesBack(const Progress& progress, const ParallelFor& parallelFor)
  {
    std::vector<Choice> choices;
    ChoiceIndex index;
    this->ForEachSharpVertex(
      [&](const Vertex& vertex)
      {
        const SharpVertex& sharp = SharpOf(vertex);
        if (sharp.reach != Reach::Own)
        {
          const AlignedBox3d cell =
            this->CellBox(this->LatticeCell(*vertex.owner->block, sharp.cell), 0.0);
          const double distance = cell.exteriorDistance(sharp.position) / this->Lattice.spacing;
          // The one that reaches into a cell of the surface gives way first, then the further one.
          const double rank = distance + (sharp.reach == Reach::Surface ? 4.0 : 0.0);
          index[this->KeyOf(vertex)] = static_cast<int>(choices.size());
          choices.push_back({ vertex, 0, this->RankOf(vertex, rank), false });
        }
      });
    this->FindLostChoices(choices, index, progress, parallelFor);
    for (const Choice& choice : choices)
    {
      if (choice.isLost)
      {
        SharpVertex& sharp = SharpOf(choice.vertex);
        sharp.position = sharp.fallback;
        sharp.reach = Reach::Own;
      }
    }
  }

  /// Joins sharp vertices also by edges that do not pass through the face between their cells, where
  /// the edge is on the surface and the new triangles meet nothing.
  void FindBridges(const Progress& progress, const ParallelFor& parallelFor)
  {
    std::vector<Choice> choices;
    ChoiceIndex index;
    for (BlockPlace& place : this->Places)
    {
      this->ForEachTriangle(place,
        [&](std::size_t, const std::array<Vertex, 3>& corners, bool isSharp, int face)
        {
          SharpFace sharpFace;
          const std::size_t sharp = corners[0].vertex - place.block->keys.size();
          if (!isSharp || !(face & 1) ||
            corners[2].vertex >= corners[2].owner->block->keys.size() ||
            !this->FindSharpFace(place, sharp, face, sharpFace) ||
            !this->IsOnSurface(SharpOf(corners[0]).position, SharpOf(sharpFace.other).position,
              corners[1], corners[2]))
          {
            return;
          }
          index[this->BridgeKey(corners[0], face)] = static_cast<int>(choices.size());
          choices.push_back({ corners[0], face, this->RankOf(corners[0], face), false });
        });
    }
    this->FindLostChoices(choices, index, progress, parallelFor);
    for (const Choice& choice : choices)
    {
      SharpFace sharpFace;
      const std::size_t sharp = choice.vertex.vertex - choice.vertex.owner->block->keys.size();
      if (!choice.isLost &&
        this->FindSharpFace(*choice.vertex.owner, sharp, choice.face, sharpFace))
      {
        choice.vertex.owner->bridges.push_back({ SharpOf(choice.vertex).cell, choice.face });
        sharpFace.other.owner->bridges.push_back(
          { SharpOf(sharpFace.other).cell, choice.face ^ 1 });
      }
    }
  }

  /// Writes the mesh layer by layer, and lets go of what no later one needs.
  void Write(const ContourArrays& arrays, const Progress& progress, const ParallelFor& parallelFor)
  {
    std::atomic<bool> torn(false);
    this->ForEachPlace(
      progress, parallelFor,
      [&](std::size_t i)
      {
        this->WritePoints(this->Places[i], arrays);
        if (this->Places[i].isOwn && !this->WriteTriangles(this->Places[i], arrays))
        {
          torn = true;
        }
      },
      [this](std::size_t layer)
      {
        if (layer > 0)
        {
          this->ReleaseLayer(layer - 1);
        }
      });
    if (torn)
    {
      throw Error("The function gave two answers for one point, so its surface cannot be closed.");
    }
  }

  void ReleaseLayer(std::size_t layer)
  {
    for (std::size_t r = this->Layers[layer].region; r < this->Layers[layer + 1].region; ++r)
    {
      this->Regions[r].blocks = {};
    }
    for (std::size_t i = this->Layers[layer].place; i < this->Layers[layer + 1].place; ++i)
    {
      this->Places[i].sharp = {};
      this->Places[i].joined = {};
      this->Places[i].bridges = {};
      this->Places[i].vertex = {};
    }
    ReturnFreeMemory();
  }

  void WritePoints(const BlockPlace& place, const ContourArrays& arrays) const
  {
    const std::size_t count = place.block->keys.size();
    for (std::size_t v = 0; v < place.NumberOfVertices(); ++v)
    {
      const std::int32_t at = VertexPlace(place, v);
      if (at >= 0)
      {
        WritePoint(arrays, at,
          v < count ? place.block->Position(this->Lattice, v) : place.sharp[v - count].position);
      }
    }
  }

  static void WritePoint(const ContourArrays& arrays, std::size_t at, const Vector3d& position)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      if (arrays.singlePoints)
      {
        arrays.singlePoints[3 * at + axis] = static_cast<float>(position[axis]);
      }
      else
      {
        arrays.doublePoints[3 * at + axis] = position[axis];
      }
    }
  }

  static std::int32_t VertexPlace(const BlockPlace& place, std::size_t vertex)
  {
    return place.isOwn       ? place.firstVertex + static_cast<std::int32_t>(vertex)
      : place.vertex.empty() ? -1
                             : place.vertex[vertex];
  }

  /// False when a vertex is not there.
  bool WriteTriangles(const BlockPlace& place, const ContourArrays& arrays) const
  {
    return this->ForEachTriangle(place,
      [&](std::size_t t, const std::array<Vertex, 3>& corners, bool isSharp, int)
      {
        const std::size_t triangle = place.firstTriangle + t;
        for (int i = 0; i < 3; ++i)
        {
          arrays.triangles[3 * triangle + i] = VertexPlace(*corners[i].owner, corners[i].vertex);
        }
        if (arrays.view)
        {
          // What most of the corners are; the first where all differ. Sharp vertices are nothing.
          const Vertex& most =
            isSharp || AreAlike(corners[1], corners[2]) ? corners[1] : corners[0];
          arrays.view[triangle] = most.owner->block->View(most.vertex);
          arrays.kind[triangle] = most.owner->block->Kind(most.vertex);
        }
      });
  }

  static bool AreAlike(const Vertex& a, const Vertex& b)
  {
    return a.owner->block->View(a.vertex) == b.owner->block->View(b.vertex) &&
      a.owner->block->Kind(a.vertex) == b.owner->block->Kind(b.vertex);
  }

  /// Sharp vertices keep so far from the sides of their cells, and new edges from those of the faces,
  /// in cells.
  static constexpr double SharpClearance = 0.01;

  /// Over which normals are smoothed before they tell of sharp edges, in cells.
  static constexpr double SmoothingRadius = 1.5;

  /// The field must show an edge or corner so close to where the planes say that it is, in cells.
  static constexpr double FeatureReach = 0.05;

  /// A sharp vertex may be so far off the surface, in cells: roughness that the smoothed normals leave
  /// out, but no other surface.
  static constexpr double VertexSlack = 0.5;

  const BoundedField Field;
  const ContourLattice Lattice;
  const ContourOptions Options;
  const bool IsSingle;
  const CrossingOptions Crossing;
  const double SharpCosine, HalfSharpCosine;

  /// Regions of one layer: where they, and their blocks, begin.
  struct Layer
  {
    std::size_t region, place;
  };

  std::vector<Region> Regions;
  std::unordered_set<std::uint64_t> OwnRegions; ///< of this piece, when it is not the whole
  std::vector<Layer> Layers;                    ///< and one more, the end
  std::vector<BlockPlace> Places;
  std::unordered_map<std::uint64_t, std::size_t> Index;
  std::size_t Vertices = 0, OwnVertices = 0, Triangles = 0;
};

}

void BisectionContour(const ContourField& field, const AlignedBox3d& bounds,
  const ContourOptions& options, const AllocateContour& allocate, const Progress& progress,
  const ParallelFor& parallelFor)
{
  options.Check();
  progress(0.0);
  if (bounds.isEmpty())
  {
    allocate({});
    return;
  }
  if (!bounds.min().allFinite() || !bounds.max().allFinite() || !(bounds.sizes().maxCoeff() > 0))
  {
    throw Error("The bounds of the contour are not a finite box with an extent.");
  }
  Contour(field, bounds, options).Run(allocate, progress, parallelFor, field.IsThreadSafe());
  ReturnFreeMemory();
}

ContourMesh BisectionContour(const ContourField& field, const AlignedBox3d& bounds,
  const ContourOptions& options, const Progress& progress, const ParallelFor& parallelFor)
{
  ContourMesh mesh;
  const auto allocate = [&mesh](const ContourSize& size)
  {
    mesh.points.resize(size.points);
    mesh.ownPoints = size.ownPoints;
    mesh.triangles.resize(size.triangles);
    mesh.view.resize(size.triangles);
    mesh.kind.resize(size.triangles);
    ContourArrays arrays;
    arrays.doublePoints = size.points ? mesh.points[0].data() : nullptr;
    arrays.triangles = size.triangles ? mesh.triangles[0].data() : nullptr;
    arrays.view = mesh.view.data();
    arrays.kind = mesh.kind.data();
    return arrays;
  };
  BisectionContour(field, bounds, options, allocate, progress, parallelFor);
  return mesh;
}

}
