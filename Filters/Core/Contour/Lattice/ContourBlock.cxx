// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/Lattice/ContourBlock.h"

#include "Contour/Lattice/MarchingCubesCases.h"

#include <algorithm>

namespace freespace
{

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

namespace
{

/// Boxes with at most this number of cells along a side are not classified any further.
constexpr int LeafSize = 2;

enum PointState : unsigned char
{
  IsFree,
  IsMatter,
  Unknown
};

}

/// Samples the field at the lattice points of a block.
class BlockSampler
{
public:
  BlockSampler(const BoundedField& field, const ContourLattice& lattice,
    const CrossingOptions& options, const CellRange& range, ContourBlock& block)
    : Field(field)
    , Lattice(lattice)
    , Options(options)
    , First(range.low)
    , Block(block)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Cells[axis] = range.high[axis] - range.low[axis];
      block.at[axis] = range.low[axis] / ContourBlock::Size;
    }
    this->State.fill(Unknown);
  }

  void Run(const FieldScope& scope);

private:
  static constexpr int Points = ContourBlock::Size + 1;

  PointState& StateAt(int i, int j, int k) { return this->State[(k * Points + j) * Points + i]; }

  Vector3d Position(int i, int j, int k) const
  {
    return this->Lattice.Point(this->First[0] + i, this->First[1] + j, this->First[2] + k);
  }

  template <typename Visit>
  static void ForEachIndex(const LatticeIndex& low, const LatticeIndex& high, Visit&& visit)
  {
    for (int k = low[2]; k < high[2]; ++k)
    {
      for (int j = low[1]; j < high[1]; ++j)
      {
        for (int i = low[0]; i < high[0]; ++i)
        {
          visit(i, j, k);
        }
      }
    }
  }

  void Ask(const CellRange& range, const FieldScope& parent, bool isMixed);
  void FindVertices(const FieldScope& scope);
  void AddVertex(const Vector3d& begin, int axis, bool beginIsFree, const FieldScope& scope);
  double Bisect(const Vector3d& matter, const Vector3d& free, const FieldScope& scope,
    SurfaceLabel& label) const;
  void FindCells();

  const BoundedField& Field;
  const ContourLattice& Lattice;
  const CrossingOptions& Options;
  const LatticeIndex First;
  LatticeIndex Cells;
  ContourBlock& Block;
  std::array<PointState, Points * Points * Points> State;
};

void BlockSampler::Run(const FieldScope& scope)
{
  this->Ask({ { 0, 0, 0 }, this->Cells }, scope, true);
  this->FindVertices(scope);
  this->FindCells();
}

// Finds the states of all points of a range of cells, upper faces included.
void BlockSampler::Ask(const CellRange& range, const FieldScope& parent, bool isMixed)
{
  const LatticeIndex end = { range.high[0] + 1, range.high[1] + 1, range.high[2] + 1 };
  FieldScope inner;
  if (!isMixed)
  {
    const AlignedBox3d box(this->Position(range.low[0], range.low[1], range.low[2]),
      this->Position(range.high[0], range.high[1], range.high[2]));
    const BoxContent content = this->Field.Classify(box, parent, inner);
    if (content != BoxContent::Mixed)
    {
      const PointState state = content == BoxContent::Free ? IsFree : IsMatter;
      ForEachIndex(range.low, end, [&](int i, int j, int k) { this->StateAt(i, j, k) = state; });
      return;
    }
  }
  const FieldScope& scope = isMixed ? parent : inner;
  if (range.Longest() > LeafSize)
  {
    for (const CellRange& part : range.Parts(1))
    {
      this->Ask(part, scope, false);
    }
    return;
  }
  ForEachIndex(range.low, end,
    [&](int i, int j, int k)
    {
      PointState& state = this->StateAt(i, j, k);
      if (state == Unknown)
      {
        state = this->Field.IsFree(this->Position(i, j, k), scope) ? IsFree : IsMatter;
      }
    });
}

void BlockSampler::FindVertices(const FieldScope& scope)
{
  ForEachIndex({ 0, 0, 0 }, this->Cells,
    [&](int i, int j, int k)
    {
      const PointState state = this->StateAt(i, j, k);
      for (int axis = 0; axis < 3; ++axis)
      {
        if (this->StateAt(i + (axis == 0), j + (axis == 1), k + (axis == 2)) != state)
        {
          this->Block.keys.push_back(ContourBlock::Key({ i, j, k }, axis));
          this->AddVertex(this->Position(i, j, k), axis, state == IsFree, scope);
        }
      }
    });
}

// Adds the vertex on the lattice edge from a point along an axis.
void BlockSampler::AddVertex(
  const Vector3d& begin, int axis, bool beginIsFree, const FieldScope& scope)
{
  const Vector3d end = begin + this->Lattice.spacing * Vector3d::Unit(axis);
  const Vector3d& matter = beginIsFree ? end : begin;
  const Vector3d& free = beginIsFree ? begin : end;
  double place;
  SurfaceLabel label;
  if (!this->Options.exact || !this->Field.Crossing(matter, free, scope, place, label))
  {
    place = this->Bisect(matter, free, scope, label);
  }
  const double clear = this->Options.clearance;
  place = std::clamp(beginIsFree ? 1.0 - place : place, clear, 1.0 - clear);
  this->Block.places.push_back(static_cast<float>(place));
  this->Block.Labels.push_back(
    static_cast<std::int16_t>(label.view * 4 + static_cast<int>(label.kind)));
  if (this->Options.keepNormals)
  {
    this->Block.normals.push_back(label.normal.cast<float>());
  }
}

// The bisection of section 2.2, from matter to free.
double BlockSampler::Bisect(
  const Vector3d& matter, const Vector3d& free, const FieldScope& scope, SurfaceLabel& label) const
{
  const auto at = [&](double s) { return Vector3d(matter + s * (free - matter)); };
  double low = 0.0, high = 1.0;
  while (high - low > this->Options.tolerance)
  {
    const double middle = 0.5 * (low + high);
    (this->Field.IsFree(at(middle), scope) ? high : low) = middle;
  }
  label = this->Field.Label(at(high), at(low), scope);
  return 0.5 * (low + high);
}

void BlockSampler::FindCells()
{
  ForEachIndex({ 0, 0, 0 }, this->Cells,
    [&](int i, int j, int k)
    {
      int matter = 0;
      for (int c = 0; c < 8; ++c)
      {
        const PointState state = this->StateAt(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1));
        matter |= (state == IsMatter) << c;
      }
      if (matter != 0 && matter != 255)
      {
        this->Block.cells.push_back(ContourBlock::CellKey({ i, j, k }));
        this->Block.cases.push_back(static_cast<std::uint8_t>(matter));
      }
    });
}

ContourBlock::ContourBlock(const BoundedField& field, const ContourLattice& lattice,
  const CrossingOptions& options, const CellRange& range, const FieldScope& scope)
{
  BlockSampler(field, lattice, options, range, *this).Run(scope);
  this->keys.shrink_to_fit();
  this->places.shrink_to_fit();
  this->normals.shrink_to_fit();
  this->Labels.shrink_to_fit();
  this->cells.shrink_to_fit();
  this->cases.shrink_to_fit();
}

Vector3d ContourBlock::Position(const ContourLattice& lattice, std::size_t vertex) const
{
  const LatticeIndex point = PointOf(this->keys[vertex]);
  Vector3d position = lattice.Point(
    Size * this->at[0] + point[0], Size * this->at[1] + point[1], Size * this->at[2] + point[2]);
  position[this->keys[vertex] % 3] += lattice.spacing * this->places[vertex];
  return position;
}

std::size_t ContourBlock::NumberOfTriangles() const
{
  std::size_t count = 0;
  for (std::uint8_t matter : this->cases)
  {
    count += MarchingCubesCases::Get().NumberOfTriangles(matter);
  }
  return count;
}

}
