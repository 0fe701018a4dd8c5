// SPDX-License-Identifier: BSD-3-Clause
#include "BisectionContour.h"

#include "ContourBlock.h"
#include "ContourEstimate.h"
#include "CubeCases.h"
#include "Error.h"
#include "SharpFeature.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
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

/// A vertex within a cell, about which the cell's triangles are a fan.
struct SharpVertex
{
  std::size_t cell; ///< place in the block's cells
  Vector3d position;
};

/// Where a block's vertices and triangles come in the mesh. The vertices are those of the block, then
/// the sharp ones.
struct BlockPlace
{
  const ContourBlock* block;
  bool isOwn;
  std::int32_t firstVertex;
  std::size_t firstTriangle;
  std::vector<SharpVertex> sharp;   ///< in the order of their cells
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
    this->PlaceBlocks(progress.Part(0.8, 0.9), parallelFor);
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
          found += 2.0 * block.keys.size();
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
        this->Places.push_back({ &block, region.isOwn, 0, 0, {}, {} });
      }
    }
    this->Layers.push_back({ this->Regions.size(), this->Places.size() });
    if (this->Options.sharp)
    {
      this->ForEachPlace(
        progress, parallelFor, [this](std::size_t i) { this->FindSharpVertices(this->Places[i]); });
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

  /// Gives the block's cells that have a sharp edge or corner a vertex there.
  void FindSharpVertices(BlockPlace& place) const
  {
    const ContourBlock& block = *place.block;
    const double sharpAngle = this->Options.sharpAngle * M_PI / 180.0;
    CrossingGrid grid;
    std::vector<SurfacePlane> planes, around;
    for (std::size_t c = 0; c < block.cells.size(); ++c)
    {
      const auto& loops = CubeCases::Get().Loops(block.cases[c]);
      if (loops.size() != 1)
      {
        continue;
      }
      if (grid.crossings.empty())
      {
        this->FillGrid(place, grid);
      }
      const LatticeIndex cell = CellOf(block.cells[c]);
      planes.clear();
      for (int edge : loops[0])
      {
        grid.Add(FirstPoint(cell, edge), edge >> 2, planes);
      }
      if (planes.size() != loops[0].size() || !NormalsDiffer(planes, std::cos(sharpAngle / 2)))
      {
        continue; // most cells
      }
      around.clear();
      grid.AddAround(cell, around);
      SmoothNormals(planes, around, SmoothingRadius * this->Lattice.spacing);
      const Vector3d low = this->CellCorner(block, cell);
      const double room = SharpClearance * this->Lattice.spacing;
      const AlignedBox3d inner(
        low + Vector3d::Constant(room), low + Vector3d::Constant(this->Lattice.spacing - room));
      Vector3d position;
      if (FindSharpFeature(planes, std::cos(sharpAngle), inner, position))
      {
        place.sharp.push_back({ c, position });
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
      [&](std::size_t, const std::array<Vertex, 3>& corners, bool)
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

  /// Calls visit(triangle, its three corners, whether it is in the fan about a sharp vertex) for all
  /// triangles of a block. In a fan, the sharp vertex is the first corner. False when a vertex is not
  /// there.
  template <typename Visit>
  bool ForEachTriangle(const BlockPlace& place, Visit&& visit) const
  {
    const CubeCases& cases = CubeCases::Get();
    const ContourBlock& block = *place.block;
    std::size_t triangle = 0, sharp = 0;
    bool whole = true;
    Neighbors neighbors = {};
    for (std::size_t c = 0; c < block.cells.size(); ++c)
    {
      const LatticeIndex cell = CellOf(block.cells[c]);
      const bool isSharp = sharp < place.sharp.size() && place.sharp[sharp].cell == c;
      for (const CubeCases::Loop& loop : cases.Loops(block.cases[c]))
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
          visit(triangle, corners, isSharp);
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
    const auto& keys = owner->block->keys;
    const auto key = std::lower_bound(keys.begin(), keys.end(), ContourBlock::Key(point, axis));
    return key != keys.end() && *key == ContourBlock::Key(point, axis) ? key - keys.begin()
                                                                       : Missing;
  }

  /// Two triangles meet on the face between two cells with sharp vertices s and t: (s, u, v) and
  /// (t, v, u). To join s and t by an edge, instead of the one that parts them, they become (s, u, t)
  /// and (t, v, s): the last corner of each changes. Both cells decide alike.
  void JoinSharp(const BlockPlace& place, std::size_t sharp, int face, Vertex& last) const
  {
    const SharpVertex& own = place.sharp[sharp];
    if (CubeCases::IsAmbiguous(place.block->cases[own.cell], face))
    {
      return;
    }
    const LatticeIndex cell = CellOf(place.block->cells[own.cell]);
    const int axis = face >> 1, isUpper = face & 1;
    LatticeIndex other = cell, faceCell = cell;
    other[axis] += isUpper ? 1 : -1;
    faceCell[axis] += isUpper;
    Vertex joined;
    if (!this->FindSharp(place, other, joined))
    {
      return;
    }
    const Vector3d& position =
      joined.owner->sharp[joined.vertex - joined.owner->block->keys.size()].position;
    const Vector3d faceLow = this->CellCorner(*place.block, faceCell);
    if (this->MayJoin(
          isUpper ? own.position : position, isUpper ? position : own.position, faceLow, axis))
    {
      last = joined;
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
  bool MayJoin(
    const Vector3d& lower, const Vector3d& upper, const Vector3d& faceLow, int axis) const
  {
    const double from = lower[axis] - faceLow[axis], to = upper[axis] - faceLow[axis];
    const Vector3d through = lower + from / (from - to) * (upper - lower);
    const double room = SharpClearance * this->Lattice.spacing;
    bool isInside = from * to < 0;
    for (int other : { (axis + 1) % 3, (axis + 2) % 3 })
    {
      const double place = through[other] - faceLow[other];
      isInside = isInside && place > room && place < this->Lattice.spacing - room;
    }
    return isInside;
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
      [&](std::size_t t, const std::array<Vertex, 3>& corners, bool isSharp)
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

  const BoundedField Field;
  const ContourLattice Lattice;
  const ContourOptions Options;
  const bool IsSingle;
  const CrossingOptions Crossing;
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
