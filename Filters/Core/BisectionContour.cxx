// SPDX-License-Identifier: BSD-3-Clause
#include "BisectionContour.h"

#include "CubeCases.h"
#include "Error.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>

namespace freespace
{

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using Index3 = std::array<int, 3>;

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
}

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

namespace
{

/// Cells along a block's side. Small blocks follow the surface closely, large ones share fewer
/// points with their neighbours.
constexpr int BlockSize = 8;
constexpr int BlockPoints = BlockSize + 1;

/// Boxes of so few cells are not classified any further.
constexpr int LeafSize = 2;

/// A mark for lattice points that have not been asked.
enum PointState : unsigned char
{
  IsFree,
  IsMatter,
  Unknown
};

/// A block that the surface may pass.
struct Block
{
  Index3 at; ///< in blocks
  FieldScope scope;

  // What the block owns: vertices on lattice edges that begin in it, and the triangles of its
  // cells.
  std::vector<std::int32_t> keys; ///< of the vertices, ascending: the edge's place in the block
  std::vector<Vector3d> points;
  std::vector<SurfaceLabel> labels;
  std::vector<std::array<std::uint32_t, 3>> triangles; ///< corners: key and neighbouring block
  std::int32_t firstVertex = 0, firstTriangle = 0;

  std::size_t Place(std::int32_t key) const
  {
    return std::lower_bound(this->keys.begin(), this->keys.end(), key) - this->keys.begin();
  }
};

/// The field within the bounds; outside of them is free.
class BoundedField
{
public:
  BoundedField(const ContourField& field, const AlignedBox3d& bounds)
    : Field(field)
    , Bounds(bounds)
  {
  }

  bool IsFree(const Vector3d& point, const FieldScope& scope) const
  {
    return !this->Bounds.contains(point) || this->Field.IsFree(point, scope);
  }

  BoxContent Classify(const AlignedBox3d& box, const FieldScope& parent, FieldScope& scope) const
  {
    if (!this->Bounds.intersects(box))
    {
      return BoxContent::Free;
    }
    const BoxContent content = this->Field.Classify(box, parent, scope);
    return content == BoxContent::Matter && !this->Bounds.contains(box) ? BoxContent::Mixed
                                                                        : content;
  }

  SurfaceLabel Label(const Vector3d& free, const Vector3d& matter) const
  {
    return this->Bounds.contains(free) ? this->Field.Label(free, matter) : SurfaceLabel();
  }

  FieldScope Root() const { return this->Field.Root(); }

private:
  const ContourField& Field;
  const AlignedBox3d Bounds;
};

/// A range of cells along each axis, [low, high).
struct CellRange
{
  Index3 low, high;

  int Longest() const { return std::max({ high[0] - low[0], high[1] - low[1], high[2] - low[2] }); }
};

/// Halves the range along each axis that is longer than the step, at a multiple of the step, and
/// visits the parts in a fixed order.
template <typename Visit>
void ForEachPart(const CellRange& range, int step, Visit&& visit)
{
  Index3 middle;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int length = range.high[axis] - range.low[axis];
    const int steps = (length + step - 1) / step;
    middle[axis] = std::min(range.low[axis] + (steps + 1) / 2 * step, range.high[axis]);
  }
  for (int part = 0; part < 8; ++part)
  {
    CellRange inner;
    bool empty = false;
    for (int axis = 0; axis < 3; ++axis)
    {
      const bool upper = (part >> axis & 1) != 0;
      inner.low[axis] = upper ? middle[axis] : range.low[axis];
      inner.high[axis] = upper ? range.high[axis] : middle[axis];
      empty = empty || inner.low[axis] >= inner.high[axis];
    }
    if (!empty)
    {
      visit(inner);
    }
  }
}

/// Finds the blocks that the surface may pass, from the whole lattice down.
class BlockFinder
{
public:
  BlockFinder(const BoundedField& field, const ContourLattice& lattice)
    : Field(field)
    , Lattice(lattice)
  {
  }

  std::vector<Block> Find()
  {
    const CellRange all = { { 0, 0, 0 }, this->Lattice.cells };
    this->Descend(all, this->Field.Root());
    std::sort(this->Blocks.begin(), this->Blocks.end(),
      [](const Block& a, const Block& b) {
        return std::lexicographical_compare(a.at.rbegin(), a.at.rend(), b.at.rbegin(), b.at.rend());
      });
    return std::move(this->Blocks);
  }

private:
  void Descend(const CellRange& range, const FieldScope& parent)
  {
    FieldScope scope;
    const AlignedBox3d box(this->Lattice.Point(range.low[0], range.low[1], range.low[2]),
      this->Lattice.Point(range.high[0], range.high[1], range.high[2]));
    if (this->Field.Classify(box, parent, scope) != BoxContent::Mixed)
    {
      return;
    }
    if (range.Longest() <= BlockSize)
    {
      Block block;
      for (int axis = 0; axis < 3; ++axis)
      {
        block.at[axis] = range.low[axis] / BlockSize;
      }
      block.scope = std::move(scope);
      this->Blocks.push_back(std::move(block));
      return;
    }
    ForEachPart(range, BlockSize, [&](const CellRange& part) { this->Descend(part, scope); });
  }

  const BoundedField& Field;
  const ContourLattice& Lattice;
  std::vector<Block> Blocks;
};

/// The contour within one block.
class BlockContour
{
public:
  BlockContour(const BoundedField& field, const ContourLattice& lattice,
    const ContourOptions& options, Block& block)
    : Field(field)
    , Lattice(lattice)
    , Options(options)
    , Own(block)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->First[axis] = block.at[axis] * BlockSize;
      this->Cells[axis] = std::min(BlockSize, lattice.cells[axis] - this->First[axis]);
    }
    this->State.fill(Unknown);
  }

  void Run()
  {
    this->Ask({ { 0, 0, 0 }, this->Cells }, this->Own.scope, true);
    this->MakeVertices();
    this->MakeTriangles();
    this->Own.scope = {};
  }

  static std::int32_t Key(int i, int j, int k, int axis)
  {
    return 3 * ((k * BlockSize + j) * BlockSize + i) + axis;
  }

private:
  static int PointIndex(int i, int j, int k) { return (k * BlockPoints + j) * BlockPoints + i; }

  Vector3d Position(int i, int j, int k) const
  {
    return this->Lattice.Point(this->First[0] + i, this->First[1] + j, this->First[2] + k);
  }

  /// Finds the state of all points of a range of cells, its faces included.
  void Ask(const CellRange& range, const FieldScope& parent, bool known)
  {
    FieldScope inner;
    const FieldScope* scope = &parent;
    if (!known)
    {
      const AlignedBox3d box(this->Position(range.low[0], range.low[1], range.low[2]),
        this->Position(range.high[0], range.high[1], range.high[2]));
      const BoxContent content = this->Field.Classify(box, parent, inner);
      scope = &inner;
      if (content != BoxContent::Mixed)
      {
        const PointState state = content == BoxContent::Free ? IsFree : IsMatter;
        this->ForEachPoint(range, [&](int i, int j, int k, PointState& at) { at = state; });
        return;
      }
    }
    if (range.Longest() > LeafSize)
    {
      ForEachPart(range, 1, [&](const CellRange& part) { this->Ask(part, *scope, false); });
      return;
    }
    this->ForEachPoint(range,
      [&](int i, int j, int k, PointState& at)
      {
        if (at == Unknown)
        {
          at = this->Field.IsFree(this->Position(i, j, k), *scope) ? IsFree : IsMatter;
        }
      });
  }

  template <typename Visit>
  void ForEachPoint(const CellRange& range, Visit&& visit)
  {
    for (int k = range.low[2]; k <= range.high[2]; ++k)
    {
      for (int j = range.low[1]; j <= range.high[1]; ++j)
      {
        for (int i = range.low[0]; i <= range.high[0]; ++i)
        {
          visit(i, j, k, this->State[PointIndex(i, j, k)]);
        }
      }
    }
  }

  void MakeVertices()
  {
    for (int k = 0; k < this->Cells[2]; ++k)
    {
      for (int j = 0; j < this->Cells[1]; ++j)
      {
        for (int i = 0; i < this->Cells[0]; ++i)
        {
          const PointState state = this->State[PointIndex(i, j, k)];
          for (int axis = 0; axis < 3; ++axis)
          {
            const Index3 end = { i + (axis == 0), j + (axis == 1), k + (axis == 2) };
            if (this->State[PointIndex(end[0], end[1], end[2])] != state)
            {
              this->Own.keys.push_back(Key(i, j, k, axis));
              this->AddVertex(this->Position(i, j, k), axis, state == IsFree);
            }
          }
        }
      }
    }
  }

  /// The bisection of section 2.2, along the lattice edge from a point up an axis.
  void AddVertex(const Vector3d& begin, int axis, bool beginIsFree)
  {
    const auto at = [&](double s)
    {
      Vector3d point = begin;
      point[axis] += s * this->Lattice.spacing;
      return point;
    };
    double low = 0.0, high = 1.0;
    while (high - low > this->Options.tolerance)
    {
      const double middle = 0.5 * (low + high);
      (this->Field.IsFree(at(middle), this->Own.scope) == beginIsFree ? low : high) = middle;
    }
    const double clear = this->Options.clearance;
    this->Own.points.push_back(at(std::clamp(0.5 * (low + high), clear, 1.0 - clear)));
    this->Own.labels.push_back(
      this->Field.Label(at(beginIsFree ? low : high), at(beginIsFree ? high : low)));
  }

  void MakeTriangles()
  {
    const CubeCases& cases = CubeCases::Get();
    for (int k = 0; k < this->Cells[2]; ++k)
    {
      for (int j = 0; j < this->Cells[1]; ++j)
      {
        for (int i = 0; i < this->Cells[0]; ++i)
        {
          int matter = 0;
          for (int c = 0; c < 8; ++c)
          {
            const int index = PointIndex(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1));
            matter |= (this->State[index] == IsMatter) << c;
          }
          for (const CubeCases::Loop& loop : cases.Loops(matter))
          {
            for (std::size_t n = 2; n < loop.size(); ++n)
            {
              this->Own.triangles.push_back({ this->Corner(i, j, k, loop[0]),
                this->Corner(i, j, k, loop[n - 1]), this->Corner(i, j, k, loop[n]) });
            }
          }
        }
      }
    }
  }

  /// The vertex on a cube's edge: its key in the block that owns it, and above that, for each axis,
  /// whether this is the next block.
  static std::uint32_t Corner(int i, int j, int k, int edge)
  {
    const int begin = CubeCases::Begin(edge);
    Index3 at = { i + (begin & 1), j + (begin >> 1 & 1), k + (begin >> 2 & 1) };
    std::uint32_t neighbor = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      if (at[axis] == BlockSize)
      {
        at[axis] = 0;
        neighbor |= 1u << axis;
      }
    }
    return neighbor << 16 | static_cast<std::uint32_t>(Key(at[0], at[1], at[2], edge >> 2));
  }

  const BoundedField& Field;
  const ContourLattice& Lattice;
  const ContourOptions& Options;
  Block& Own;
  Index3 First, Cells;
  std::array<PointState, BlockPoints * BlockPoints * BlockPoints> State;
};

/// The label that most of three vertices have; the first one's where all differ.
const SurfaceLabel& Majority(const SurfaceLabel& a, const SurfaceLabel& b, const SurfaceLabel& c)
{
  return b.view == c.view && b.kind == c.kind ? b : a;
}

/// Joins the blocks' vertices and triangles, in the order of the blocks.
ContourMesh Join(std::vector<Block>& blocks, const ParallelFor& parallelFor)
{
  std::size_t vertices = 0, triangles = 0;
  for (Block& block : blocks)
  {
    block.firstVertex = static_cast<std::int32_t>(vertices);
    block.firstTriangle = static_cast<std::int32_t>(triangles);
    vertices += block.points.size();
    triangles += block.triangles.size();
    if (vertices > INT32_MAX || triangles > INT32_MAX)
    {
      throw Error("The surface has more than 2^31 vertices or triangles, use fewer cells.");
    }
  }
  ContourMesh mesh;
  mesh.points.resize(vertices);
  mesh.triangles.resize(triangles);
  mesh.view.resize(triangles);
  mesh.kind.resize(triangles);
  const auto find = [&blocks](const Index3& at) -> const Block*
  {
    const auto block = std::lower_bound(blocks.begin(), blocks.end(), at,
      [](const Block& a, const Index3& b)
      { return std::lexicographical_compare(a.at.rbegin(), a.at.rend(), b.rbegin(), b.rend()); });
    return block != blocks.end() && block->at == at ? &*block : nullptr;
  };
  std::atomic<bool> torn(false);
  parallelFor(blocks.size(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t b = begin; b < end; ++b)
      {
        const Block& block = blocks[b];
        std::copy(
          block.points.begin(), block.points.end(), mesh.points.begin() + block.firstVertex);
        std::array<const Block*, 8> owners = {};
        owners[0] = &block;
        for (std::size_t t = 0; t < block.triangles.size(); ++t)
        {
          const SurfaceLabel* labels[3];
          for (int corner = 0; corner < 3; ++corner)
          {
            const std::uint32_t neighbor = block.triangles[t][corner] >> 16;
            const std::int32_t key = block.triangles[t][corner] & 0xffff;
            const Block*& owner = owners[neighbor];
            if (!owner)
            {
              owner = find({ block.at[0] + static_cast<int>(neighbor & 1),
                block.at[1] + static_cast<int>(neighbor >> 1 & 1),
                block.at[2] + static_cast<int>(neighbor >> 2 & 1) });
            }
            const std::size_t place = owner ? owner->Place(key) : 0;
            if (!owner || place == owner->keys.size() || owner->keys[place] != key)
            {
              torn = true;
              return;
            }
            mesh.triangles[block.firstTriangle + t][corner] =
              owner->firstVertex + static_cast<std::int32_t>(place);
            labels[corner] = &owner->labels[place];
          }
          const SurfaceLabel& label = Majority(*labels[0], *labels[1], *labels[2]);
          mesh.view[block.firstTriangle + t] = label.view;
          mesh.kind[block.firstTriangle + t] = label.kind;
        }
      }
    });
  if (torn)
  {
    throw Error("The function gave two answers for one point, so its surface cannot be closed.");
  }
  return mesh;
}

}

ContourMesh BisectionContour(const ContourField& field, const AlignedBox3d& bounds,
  const ContourOptions& options, const Progress& progress, const ParallelFor& parallelFor)
{
  options.Check();
  progress(0.0);
  if (bounds.isEmpty())
  {
    return {};
  }
  if (!bounds.min().allFinite() || !bounds.max().allFinite() || !(bounds.sizes().maxCoeff() > 0))
  {
    throw Error("The bounds of the contour are not a finite box with an extent.");
  }
  const BoundedField bounded(field, bounds);
  const ContourLattice lattice(bounds, options.cells);
  std::vector<Block> blocks = BlockFinder(bounded, lattice).Find();
  // Threads get a portion at a time; between portions there is a chance to tell and to stop.
  const ParallelFor& within = field.IsThreadSafe() ? parallelFor : ParallelFor(SerialFor);
  const std::size_t portion = 128;
  for (std::size_t done = 0; done < blocks.size(); done += portion)
  {
    progress(0.95 * done / blocks.size());
    within(std::min(portion, blocks.size() - done),
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = done + begin; i < done + end; ++i)
        {
          BlockContour(bounded, lattice, options, blocks[i]).Run();
        }
      });
  }
  progress(0.95);
  ContourMesh mesh = Join(blocks, parallelFor);
  progress(1.0);
  return mesh;
}

}
