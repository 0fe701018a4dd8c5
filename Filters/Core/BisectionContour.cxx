// SPDX-License-Identifier: BSD-3-Clause
#include "BisectionContour.h"

#include "ContourBlock.h"
#include "CubeCases.h"
#include "Error.h"
#include "SharpFeature.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
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
  if (!(this->sharpAngle > 0 && this->sharpAngle < 180))
  {
    throw Error("The sharp angle is " + std::to_string(this->sharpAngle) +
      " degrees, it must be between 0 and 180.");
  }
  if (this->sharp && this->pieces > 1)
  {
    throw Error("A contour with sharp edges cannot be made in pieces.");
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

/// A vertex within a cell, about which the cell's triangles are a fan.
struct SharpVertex
{
  std::size_t cell; ///< place in the block's cells
  Vector3d position;
};

/// Where a block's vertices and triangles come in the mesh.
struct BlockPlace
{
  const ContourBlock* block;
  bool isOwn;
  std::int32_t firstVertex;
  std::size_t firstTriangle;
  std::vector<SharpVertex> sharp;   ///< in the order of their cells, after the block's own vertices
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
    , Crossing{ options.tolerance, options.clearance, options.exact, options.sharp }
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
    this->PlaceBlocks(parallelFor);
    progress(0.95);
    const ContourArrays arrays = allocate(this->Vertices, this->Triangles);
    this->Write(arrays, parallelFor);
    if (this->Options.sharp)
    {
      this->FlipToSharpEdges(arrays);
    }
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

  void PlaceBlocks(const ParallelFor& parallelFor)
  {
    for (const Region& region : this->Regions)
    {
      for (const ContourBlock& block : region.blocks)
      {
        this->Index[PlaceKey(block.at)] = this->Places.size();
        this->Places.push_back({ &block, region.isOwn, 0, 0, {}, {} });
      }
    }
    if (this->Options.sharp)
    {
      parallelFor(this->Places.size(),
        [&](std::size_t begin, std::size_t end)
        {
          for (std::size_t i = begin; i < end; ++i)
          {
            this->FindSharpVertices(this->Places[i]);
          }
        });
    }
    for (BlockPlace& place : this->Places)
    {
      place.firstVertex = static_cast<std::int32_t>(this->Vertices);
      place.firstTriangle = this->Triangles;
      if (place.isOwn)
      {
        // A fan about a vertex of its own has two triangles more.
        this->Vertices += place.block->keys.size() + place.sharp.size();
        this->Triangles += place.block->NumberOfTriangles() + 2 * place.sharp.size();
      }
      this->CheckSize();
    }
    for (std::size_t i = 0; i < this->Places.size() && this->Options.pieces > 1; ++i)
    {
      this->CountForeign(this->Places[i]);
    }
  }

  /// Gives the block's cells that have a sharp edge or corner a vertex there.
  void FindSharpVertices(BlockPlace& place) const
  {
    const ContourBlock& block = *place.block;
    const double sharpCosine = std::cos(this->Options.sharpAngle * M_PI / 180.0);
    std::vector<SurfacePlane> planes;
    for (std::size_t c = 0; c < block.cells.size(); ++c)
    {
      const auto& loops = CubeCases::Get().Loops(block.cases[c]);
      if (loops.size() != 1)
      {
        continue;
      }
      planes.clear();
      const LatticeIndex cell = CellOf(block.cells[c]);
      for (int edge : loops[0])
      {
        BlockPlace* owner = nullptr;
        const std::size_t vertex =
          this->FindVertex(place, FirstPoint(cell, edge), edge >> 2, owner);
        if (vertex != Missing)
        {
          planes.push_back({ owner->block->Position(this->Lattice, vertex),
            owner->block->normals[vertex].cast<double>() });
        }
      }
      const Vector3d low = this->CellCorner(block, cell);
      const double room = SharpClearance * this->Lattice.spacing;
      const AlignedBox3d inner(
        low + Vector3d::Constant(room), low + Vector3d::Constant(this->Lattice.spacing - room));
      Vector3d position;
      if (planes.size() == loops[0].size() &&
        FindSharpFeature(planes, sharpCosine, inner, position))
      {
        place.sharp.push_back({ c, position });
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
    ForEachTriangle(own,
      [&](std::size_t, const std::array<Corner, 3>& corners, std::size_t, auto)
      {
        for (const Corner& corner : corners)
        {
          BlockPlace* owner = nullptr;
          const std::size_t vertex = this->FindVertex(own, corner.point, corner.axis, owner);
          if (vertex != Missing && !owner->isOwn)
          {
            owner->vertex.resize(owner->block->keys.size(), -1);
            if (owner->vertex[vertex] < 0)
            {
              owner->vertex[vertex] = static_cast<std::int32_t>(this->Vertices++);
              this->CheckSize();
            }
          }
        }
      });
  }

  /// A corner of a triangle: on a lattice edge, from a point up an axis, or the cell's sharp vertex.
  struct Corner
  {
    LatticeIndex point;
    int axis;
    std::ptrdiff_t sharp; ///< place in the block's list, or -1
  };

  /// Calls visit(triangle, its three corners, place of its cell, its two last cube edges) for all
  /// triangles of a block. In the fan about a sharp vertex, this is the first corner.
  template <typename Visit>
  static void ForEachTriangle(const BlockPlace& place, Visit&& visit)
  {
    const CubeCases& cases = CubeCases::Get();
    const ContourBlock& block = *place.block;
    std::size_t triangle = 0, sharp = 0;
    for (std::size_t c = 0; c < block.cells.size(); ++c)
    {
      const LatticeIndex cell = CellOf(block.cells[c]);
      const auto corner = [&cell](int edge) {
        return Corner{ FirstPoint(cell, edge), edge >> 2, -1 };
      };
      const bool isSharp = sharp < place.sharp.size() && place.sharp[sharp].cell == c;
      for (const CubeCases::Loop& loop : cases.Loops(block.cases[c]))
      {
        const std::size_t size = loop.size();
        const Corner apex =
          isSharp ? Corner{ cell, 0, static_cast<std::ptrdiff_t>(sharp) } : corner(loop[0]);
        for (std::size_t n = isSharp ? 0 : 2; n < size; ++n, ++triangle)
        {
          const int from = loop[n > 0 ? n - 1 : size - 1], to = loop[n];
          visit(triangle, std::array<Corner, 3>{ apex, corner(from), corner(to) }, c,
            std::make_pair(from, to));
        }
      }
      sharp += isSharp;
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
    const std::size_t count = place.block->keys.size();
    for (std::size_t v = 0; v < count; ++v)
    {
      const std::int32_t at = VertexPlace(place, v);
      if (at >= 0)
      {
        WritePoint(arrays, at, place.block->Position(this->Lattice, v));
      }
    }
    for (std::size_t i = 0; i < place.sharp.size(); ++i)
    {
      WritePoint(arrays, place.firstVertex + count + i, place.sharp[i].position);
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
    bool whole = true;
    std::array<BlockPlace*, 8> owners = {};
    const int size = ContourBlock::Size;
    ForEachTriangle(place,
      [&](std::size_t t, const std::array<Corner, 3>& corners, std::size_t, auto)
      {
        int view[3];
        SurfaceKind kind[3];
        const std::size_t triangle = place.firstTriangle + t;
        const bool isSharp = corners[0].sharp >= 0;
        for (int i = 0; i < 3; ++i)
        {
          if (corners[i].sharp >= 0)
          {
            arrays.triangles[3 * triangle + i] =
              VertexPlace(place, place.block->keys.size() + corners[i].sharp);
            continue;
          }
          const LatticeIndex& point = corners[i].point;
          BlockPlace*& owner =
            owners[point[0] / size | point[1] / size << 1 | point[2] / size << 2];
          const std::size_t vertex = this->FindVertex(place, point, corners[i].axis, owner);
          if (vertex == Missing)
          {
            whole = false;
            return;
          }
          arrays.triangles[3 * triangle + i] = VertexPlace(*owner, vertex);
          view[i] = owner->block->View(vertex);
          kind[i] = owner->block->Kind(vertex);
        }
        if (arrays.view)
        {
          // What most of the corners are; the first where all differ.
          const int most = isSharp || (view[1] == view[2] && kind[1] == kind[2]) ? 1 : 0;
          arrays.view[triangle] = view[most];
          arrays.kind[triangle] = kind[most];
        }
      });
    return whole;
  }

  /// A triangle of a fan about a sharp vertex, with the edge that it has on a face of its cell.
  struct FanTriangle
  {
    std::int32_t low, high; ///< ends of the edge, in order
    std::int32_t sharp;
    std::size_t triangle;
    Vector3d position; ///< of the sharp vertex
    Vector3d faceLow;  ///< the face's first corner
    int faceAxis;
  };

  /// Joins sharp vertices of neighbouring cells by an edge, instead of the one that parts them.
  void FlipToSharpEdges(const ContourArrays& arrays) const
  {
    std::vector<FanTriangle> fans = this->CollectFans(arrays);
    std::sort(fans.begin(), fans.end(),
      [](const FanTriangle& a, const FanTriangle& b)
      { return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle); });
    for (std::size_t i = 0; i + 1 < fans.size(); ++i)
    {
      const FanTriangle &a = fans[i], &b = fans[i + 1];
      if (a.low == b.low && a.high == b.high && this->MayJoin(a, b))
      {
        // (s, u, v) and (t, v, u) become (s, u, t) and (t, v, s).
        arrays.triangles[3 * a.triangle + 2] = b.sharp;
        arrays.triangles[3 * b.triangle + 2] = a.sharp;
      }
    }
  }

  std::vector<FanTriangle> CollectFans(const ContourArrays& arrays) const
  {
    std::vector<FanTriangle> fans;
    for (const BlockPlace& place : this->Places)
    {
      if (place.sharp.empty())
      {
        continue;
      }
      ForEachTriangle(place,
        [&](std::size_t t, const std::array<Corner, 3>& corners, std::size_t c,
          const std::pair<int, int>& edges)
        {
          if (corners[0].sharp < 0)
          {
            return;
          }
          const int face = CubeCases::CommonFace(edges.first, edges.second);
          if (CubeCases::IsAmbiguous(place.block->cases[c], face))
          {
            return;
          }
          const std::size_t triangle = place.firstTriangle + t;
          const std::int32_t* ids = arrays.triangles + 3 * triangle;
          LatticeIndex cell = CellOf(place.block->cells[c]);
          cell[face >> 1] += face & 1;
          fans.push_back({ std::min(ids[1], ids[2]), std::max(ids[1], ids[2]), ids[0], triangle,
            place.sharp[corners[0].sharp].position, this->CellCorner(*place.block, cell),
            face >> 1 });
        });
    }
    return fans;
  }

  /// Whether the new edge passes through the face between its cells, well off its border: then the
  /// new triangles stay within the two cells, where nothing else is on that face.
  bool MayJoin(const FanTriangle& a, const FanTriangle& b) const
  {
    const int axis = a.faceAxis;
    const double from = a.position[axis] - a.faceLow[axis];
    const double to = b.position[axis] - a.faceLow[axis];
    const Vector3d through = a.position + from / (from - to) * (b.position - a.position);
    const double room = SharpClearance * this->Lattice.spacing;
    bool isInside = from * to < 0;
    for (int other : { (axis + 1) % 3, (axis + 2) % 3 })
    {
      const double place = through[other] - a.faceLow[other];
      isInside = isInside && place > room && place < this->Lattice.spacing - room;
    }
    return isInside;
  }

  /// Sharp vertices keep so far from the sides of their cells, and new edges from those of the faces,
  /// in cells.
  static constexpr double SharpClearance = 0.01;

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
