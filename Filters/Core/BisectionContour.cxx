// SPDX-License-Identifier: BSD-3-Clause
#include "BisectionContour.h"

#include "ContourBlock.h"
#include "CubeCases.h"
#include "Error.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_map>

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

/// So many regions are done between two looks at the progress.
constexpr std::size_t RegionsAtATime = 16;

/// A part of the lattice that the surface may pass.
struct Region
{
  CellRange range;
  FieldScope scope;
  bool isOwn; ///< of this piece; otherwise only its vertices are wanted
  std::vector<ContourBlock> blocks;
};

/// Where a block's vertices and triangles come in the mesh.
struct BlockPlace
{
  const ContourBlock* block;
  bool isOwn;
  std::int32_t firstVertex;
  std::size_t firstTriangle;
  std::vector<std::int32_t> vertex; ///< of another piece's block: place in the mesh, or -1
};

std::uint64_t PlaceKey(const LatticeIndex& at)
{
  const auto bits = [](int x) { return static_cast<std::uint64_t>(x); };
  return bits(at[0]) | bits(at[1]) << 21 | bits(at[2]) << 42;
}

/// Descends the octree of boxes below a range to those of the wanted size that are mixed.
template <typename Visit>
void Descend(const BoundedField& field, const ContourLattice& lattice, const CellRange& range,
  int size, const FieldScope& parent, Visit&& visit)
{
  FieldScope scope;
  if (field.Classify(range.Box(lattice), parent, scope) != BoxContent::Mixed)
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
    Descend(field, lattice, part, size, scope, visit);
  }
}

class Contour
{
public:
  Contour(const ContourField& field, const AlignedBox3d& bounds, const ContourOptions& options)
    : Field(field, bounds)
    , Lattice(bounds, options.cells)
    , Options(options)
    , Crossing{ options.tolerance, options.clearance, options.exact }
  {
  }

  void Run(const AllocateContour& allocate, const Progress& progress,
    const ParallelFor& parallelFor, bool isThreadSafe)
  {
    this->FindRegions();
    const std::size_t portion = isThreadSafe ? RegionsAtATime : 1;
    const ParallelFor within = isThreadSafe ? parallelFor : ParallelFor(SerialFor);
    const std::size_t count = this->Regions.size();
    for (std::size_t done = 0; done < count; done += portion)
    {
      progress(0.9 * done / count);
      within(std::min(portion, count - done),
        [&](std::size_t begin, std::size_t end)
        {
          for (std::size_t i = done + begin; i < done + end; ++i)
          {
            this->RunRegion(this->Regions[i]);
          }
        });
    }
    progress(0.9);
    this->PlaceBlocks();
    progress(0.95);
    this->Write(allocate(this->Vertices, this->Triangles), parallelFor);
    progress(1.0);
  }

private:
  /// The regions of this piece, and those above them, whose vertices its upper faces need.
  void FindRegions()
  {
    const CellRange all = { { 0, 0, 0 }, this->Lattice.cells };
    Descend(this->Field, this->Lattice, all, RegionSize, this->Field.Root(),
      [&](const CellRange& range, FieldScope& scope) {
        this->Regions.push_back({ range, std::move(scope), true, {} });
      });
    if (this->Options.pieces == 1)
    {
      return;
    }
    const std::size_t count = this->Regions.size(), pieces = this->Options.pieces;
    std::unordered_map<std::uint64_t, std::size_t> places;
    for (std::size_t i = 0; i < count; ++i)
    {
      places[PlaceKey(this->Regions[i].range.low)] = i;
      this->Regions[i].isOwn = i * pieces / count == static_cast<std::size_t>(this->Options.piece);
    }
    std::vector<char> isWanted(count, 0);
    for (const Region& region : this->Regions)
    {
      for (int upper = 0; upper < 8 && region.isOwn; ++upper)
      {
        LatticeIndex low = region.range.low;
        for (int axis = 0; axis < 3; ++axis)
        {
          low[axis] += (upper >> axis & 1) * RegionSize;
        }
        const auto place = places.find(PlaceKey(low));
        if (place != places.end())
        {
          isWanted[place->second] = 1;
        }
      }
    }
    std::vector<Region> wanted;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (isWanted[i])
      {
        wanted.push_back(std::move(this->Regions[i]));
      }
    }
    this->Regions = std::move(wanted);
  }

  void RunRegion(Region& region) const
  {
    Descend(this->Field, this->Lattice, region.range, ContourBlock::Size, region.scope,
      [&](const CellRange& range, const FieldScope& scope)
      {
        ContourBlock block(this->Field, this->Lattice, this->Crossing, range, scope);
        if (!block.keys.empty() || !block.cells.empty())
        {
          region.blocks.push_back(std::move(block));
        }
      });
    region.scope = {};
  }

  void PlaceBlocks()
  {
    for (const Region& region : this->Regions)
    {
      for (const ContourBlock& block : region.blocks)
      {
        this->Index[PlaceKey(block.at)] = this->Places.size();
        this->Places.push_back(
          { &block, region.isOwn, static_cast<std::int32_t>(this->Vertices), this->Triangles, {} });
        this->Vertices += region.isOwn ? block.keys.size() : 0;
        this->Triangles += region.isOwn ? block.NumberOfTriangles() : 0;
        this->CheckSize();
      }
    }
    for (std::size_t i = 0; i < this->Places.size() && this->Options.pieces > 1; ++i)
    {
      this->CountForeign(this->Places[i]);
    }
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
    this->ForEachCorner(*own.block,
      [&](std::size_t, int, const LatticeIndex& point, int axis)
      {
        BlockPlace* owner = nullptr;
        const std::size_t vertex = this->FindVertex(own, point, axis, owner);
        if (vertex != Missing && !owner->isOwn)
        {
          owner->vertex.resize(owner->block->keys.size(), -1);
          if (owner->vertex[vertex] < 0)
          {
            owner->vertex[vertex] = static_cast<std::int32_t>(this->Vertices++);
            this->CheckSize();
          }
        }
      });
  }

  /// Calls visit(triangle, corner, first point of the lattice edge from the block's, its axis).
  template <typename Visit>
  static void ForEachCorner(const ContourBlock& block, Visit&& visit)
  {
    const CubeCases& cases = CubeCases::Get();
    std::size_t triangle = 0;
    for (std::size_t c = 0; c < block.cells.size(); ++c)
    {
      const int cell = block.cells[c], size = ContourBlock::Size;
      const LatticeIndex at = { cell % size, cell / size % size, cell / (size * size) };
      for (const CubeCases::Loop& loop : cases.Loops(block.cases[c]))
      {
        for (std::size_t n = 2; n < loop.size(); ++n, ++triangle)
        {
          int corner = 0;
          for (int edge : { loop[0], loop[n - 1], loop[n] })
          {
            const int begin = CubeCases::Begin(edge);
            visit(triangle, corner++,
              LatticeIndex{
                at[0] + (begin & 1), at[1] + (begin >> 1 & 1), at[2] + (begin >> 2 & 1) },
              edge >> 2);
          }
        }
      }
    }
  }

  static constexpr std::size_t Missing = static_cast<std::size_t>(-1);

  /// The vertex on a lattice edge, in the block that owns it.
  std::size_t FindVertex(
    const BlockPlace& from, LatticeIndex point, int axis, BlockPlace*& owner) const
  {
    LatticeIndex at = from.block->at;
    for (int a = 0; a < 3; ++a)
    {
      at[a] += point[a] / ContourBlock::Size;
      point[a] %= ContourBlock::Size;
    }
    if (!owner || owner->block->at != at)
    {
      const auto place = this->Index.find(PlaceKey(at));
      if (place == this->Index.end())
      {
        return Missing;
      }
      owner = const_cast<BlockPlace*>(&this->Places[place->second]);
    }
    const auto& keys = owner->block->keys;
    const auto key = std::lower_bound(keys.begin(), keys.end(), ContourBlock::Key(point, axis));
    return key != keys.end() && *key == ContourBlock::Key(point, axis) ? key - keys.begin()
                                                                       : Missing;
  }

  void Write(const ContourArrays& arrays, const ParallelFor& parallelFor) const
  {
    std::atomic<bool> torn(false);
    parallelFor(this->Places.size(),
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          this->WritePoints(this->Places[i], arrays);
          if (this->Places[i].isOwn && !this->WriteTriangles(this->Places[i], arrays))
          {
            torn = true;
          }
        }
      });
    if (torn)
    {
      throw Error("The function gave two answers for one point, so its surface cannot be closed.");
    }
  }

  void WritePoints(const BlockPlace& place, const ContourArrays& arrays) const
  {
    for (std::size_t v = 0; v < place.block->keys.size(); ++v)
    {
      const std::ptrdiff_t at = VertexPlace(place, v);
      if (at >= 0)
      {
        const Vector3d position = place.block->Position(this->Lattice, v);
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
    bool whole = true;
    int view[3];
    SurfaceKind kind[3];
    std::array<BlockPlace*, 8> owners = {};
    this->ForEachCorner(*place.block,
      [&](std::size_t t, int corner, const LatticeIndex& point, int axis)
      {
        const int size = ContourBlock::Size;
        BlockPlace*& owner = owners[point[0] / size | point[1] / size << 1 | point[2] / size << 2];
        const std::size_t vertex = this->FindVertex(place, point, axis, owner);
        if (vertex == Missing)
        {
          whole = false;
          return;
        }
        const std::size_t triangle = place.firstTriangle + t;
        arrays.triangles[3 * triangle + corner] = VertexPlace(*owner, vertex);
        view[corner] = owner->block->View(vertex);
        kind[corner] = owner->block->Kind(vertex);
        if (corner == 2 && arrays.view)
        {
          // What most of the corners are; the first where all differ.
          const int most = view[1] == view[2] && kind[1] == kind[2] ? 1 : 0;
          arrays.view[triangle] = view[most];
          arrays.kind[triangle] = kind[most];
        }
      });
    return whole;
  }

  const BoundedField Field;
  const ContourLattice Lattice;
  const ContourOptions Options;
  const CrossingOptions Crossing;
  std::vector<Region> Regions;
  std::vector<BlockPlace> Places;
  std::unordered_map<std::uint64_t, std::size_t> Index;
  std::size_t Vertices = 0, Triangles = 0;
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
    allocate(0, 0);
    return;
  }
  if (!bounds.min().allFinite() || !bounds.max().allFinite() || !(bounds.sizes().maxCoeff() > 0))
  {
    throw Error("The bounds of the contour are not a finite box with an extent.");
  }
  Contour(field, bounds, options).Run(allocate, progress, parallelFor, field.IsThreadSafe());
}

ContourMesh BisectionContour(const ContourField& field, const AlignedBox3d& bounds,
  const ContourOptions& options, const Progress& progress, const ParallelFor& parallelFor)
{
  ContourMesh mesh;
  const auto allocate = [&mesh](std::size_t points, std::size_t triangles)
  {
    mesh.points.resize(points);
    mesh.triangles.resize(triangles);
    mesh.view.resize(triangles);
    mesh.kind.resize(triangles);
    ContourArrays arrays;
    arrays.doublePoints = points ? mesh.points[0].data() : nullptr;
    arrays.triangles = triangles ? mesh.triangles[0].data() : nullptr;
    arrays.view = mesh.view.data();
    arrays.kind = mesh.kind.data();
    return arrays;
  };
  BisectionContour(field, bounds, options, allocate, progress, parallelFor);
  return mesh;
}

}
