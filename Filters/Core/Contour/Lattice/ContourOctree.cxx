// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/Lattice/ContourOctree.h"

#include "Contour/Lattice/ContourEstimate.h"

#include <algorithm>

namespace freespace
{

using Eigen::AlignedBox3d;

namespace
{

/// Cells along the side of a region: what one thread does at a time.
constexpr int RegionSize = 4 * ContourBlock::Size;

/// Up to this number of cells, regions are few enough to be found without an estimate.
constexpr int QuicklyDescended = 1536;

/// The number of steps between two reports of progress.
constexpr std::size_t RegionsAtATime = 16;
constexpr std::size_t RangesAtATime = 1024;

/// Descends the octree of boxes below a range to those of the wanted size that are mixed. Looks at
/// those only that are wanted, which also narrows the scope of a change.
template <typename Want, typename Visit>
void Descend(const BoundedField& field, const ContourLattice& lattice, const CellRange& range,
  int size, const FieldScope& parent, const ChangeScope& parentChange, Want&& isWanted,
  Visit&& visit)
{
  FieldScope scope;
  ChangeScope change;
  if (!isWanted(range, parentChange, change) ||
    field.Classify(range.Box(lattice), parent, scope) != BoxContent::Mixed)
  {
    return;
  }
  if (range.Longest() <= size)
  {
    visit(range, scope, change);
    return;
  }
  for (const CellRange& part : range.Parts(size))
  {
    Descend(field, lattice, part, size, scope, change, isWanted, visit);
  }
}

/// Whether a box of cells lies in another one.
bool Contains(const CellRange& outer, const LatticeIndex& low)
{
  bool isIn = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    isIn = isIn && low[axis] >= outer.low[axis] && low[axis] < outer.high[axis];
  }
  return isIn;
}

}

std::uint64_t LatticeKey(const LatticeIndex& at)
{
  const auto bits = [](int x) { return static_cast<std::uint64_t>(x); };
  return bits(at[0]) | bits(at[1]) << 21 | bits(at[2]) << 42;
}

ContourOctree::ContourOctree(
  const ContourField& whole, const AlignedBox3d& bounds, const ContourOptions& options)
  : field(whole, bounds)
  , lattice(bounds, options.cells)
  , isSingle(SinglePrecisionSuffices(bounds, options))
  , Options(options)
  , Crossing{ options.tolerance, options.clearance, options.exact, options.sharp }
{
}

void ContourOctree::Find(
  const Progress& progress, const ParallelFor& parallelFor, bool isThreadSafe)
{
  if (this->Options.cells > QuicklyDescended)
  {
    this->CheckEstimate(progress);
  }
  this->FindRegions(progress.Part(0.0, 0.0625));
  this->FindBlocks(progress.Part(0.0625, 1.0), parallelFor, isThreadSafe);
}

void ContourOctree::TakeOver(std::vector<Region> before, const FieldChange& change)
{
  this->Change = &change;
  for (Region& region : before)
  {
    this->Before.emplace(LatticeKey(region.range.low), std::move(region));
  }
}

void ContourOctree::TakeRegions(const CellRange& range)
{
  if (range.Longest() > RegionSize)
  {
    for (const CellRange& part : range.Parts(RegionSize))
    {
      this->TakeRegions(part);
    }
    return;
  }
  const auto before = this->Before.find(LatticeKey(range.low));
  if (before != this->Before.end())
  {
    Region& region = before->second;
    this->regions.push_back({ range, {}, true, 0, {}, std::move(region.blocks), {} });
    this->regions.back().isLeft = true;
  }
}

void ContourOctree::TakeBlocks(const CellRange& range, Region& region) const
{
  for (ContourBlock& block : region.before)
  {
    LatticeIndex low = block.at;
    for (int& index : low)
    {
      index *= ContourBlock::Size;
    }
    if (Contains(range, low))
    {
      block.RenumberViews([this](int view) { return this->Change->ViewNow(view); });
      region.blocks.push_back(std::move(block));
    }
  }
}

void ContourOctree::CheckEstimate(const Progress& progress) const
{
  if (this->Options.memoryLimit > 0)
  {
    const ContourEstimate estimate =
      EstimateContour(this->field.Inner(), this->field.Box(), this->Options, progress);
    CheckMemoryLimit(estimate.triangles / this->Options.pieces, this->Options, this->isSingle);
  }
}

void ContourOctree::FindRegions(const Progress& progress)
{
  const CellRange all = { { 0, 0, 0 }, this->lattice.cells };
  std::size_t asked = 0;
  Descend(
    this->field, this->lattice, all, RegionSize, this->field.Root(),
    this->Change ? this->Change->Root() : ChangeScope(),
    [&](const CellRange& range, const ChangeScope& parent, ChangeScope& change)
    {
      if (asked++ % RangesAtATime == 0)
      {
        progress(0.0);
      }
      if (this->Change && this->Change->Leaves(range.Box(this->lattice), parent, change))
      {
        this->TakeRegions(range);
        return false;
      }
      return true;
    },
    [&](const CellRange& range, FieldScope& scope, ChangeScope& change)
    {
      this->regions.push_back({ range, std::move(scope), true, 0, {}, {}, std::move(change) });
      const auto before = this->Before.find(LatticeKey(range.low));
      if (before != this->Before.end())
      {
        this->regions.back().before = std::move(before->second.blocks);
      }
    });
  this->Before.clear();
  // Many regions are few triangles, unless the surface is rough.
  const double worst = 5.0 * RegionSize * RegionSize * RegionSize * this->regions.size();
  if (this->Options.cells <= QuicklyDescended &&
    ContourMegabytes(worst, this->Options, this->isSingle) > this->Options.memoryLimit)
  {
    this->CheckEstimate(progress);
  }
  // Layer by layer along the longest side, so that written data can be released early.
  const auto& cells = this->lattice.cells;
  const auto height = [axis = std::max_element(cells.begin(), cells.end()) - cells.begin()](
                        const Region& region) { return region.range.low[axis] / RegionSize; };
  std::stable_sort(this->regions.begin(), this->regions.end(),
    [&](const Region& a, const Region& b) { return height(a) < height(b); });
  for (Region& region : this->regions)
  {
    region.layer = height(region);
  }
  if (this->Options.pieces > 1)
  {
    this->KeepPiece();
  }
}

void ContourOctree::KeepPiece()
{
  const std::size_t count = this->regions.size(), pieces = this->Options.pieces;
  for (std::size_t i = 0; i < count; ++i)
  {
    Region& region = this->regions[i];
    region.isOwn = i * pieces / count == static_cast<std::size_t>(this->Options.piece);
    if (region.isOwn)
    {
      this->OwnRegions.insert(LatticeKey(region.range.low));
    }
  }
  const auto isAway = [this](const Region& region)
  { return !region.isOwn && !this->IsBesideOwn(region.range.low, RegionSize); };
  this->regions.erase(
    std::remove_if(this->regions.begin(), this->regions.end(), isAway), this->regions.end());
}

bool ContourOctree::IsBesideOwn(const LatticeIndex& low, int size) const
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
          this->OwnRegions.count(LatticeKey({ other[0] / RegionSize * RegionSize,
            other[1] / RegionSize * RegionSize, other[2] / RegionSize * RegionSize })))
        {
          return true;
        }
      }
    }
  }
  return false;
}

void ContourOctree::FindBlocks(
  const Progress& progress, const ParallelFor& parallelFor, bool isThreadSafe)
{
  const std::size_t portion = isThreadSafe ? RegionsAtATime : 1;
  const std::size_t count = this->regions.size();
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
          // Only the calling thread may report progress.
          this->RunRegion(this->regions[i], isThreadSafe ? Progress() : progress, fraction);
        }
      });
    for (std::size_t i = done; i < std::min(done + portion, count); ++i)
    {
      for (const ContourBlock& block : this->regions[i].blocks)
      {
        found += this->regions[i].isOwn ? 2.0 * block.keys.size() : 0.0;
      }
    }
    CheckMemoryLimit(found, this->Options, this->isSingle);
  }
  progress(1.0);
}

void ContourOctree::RunRegion(Region& region, const Progress& progress, double fraction) const
{
  if (region.isLeft)
  {
    this->TakeBlocks(region.range, region);
    region.before = {};
    return;
  }
  Descend(
    this->field, this->lattice, region.range, ContourBlock::Size, region.scope, region.change,
    [&](const CellRange& range, const ChangeScope& parent, ChangeScope& change)
    {
      if (this->Change && this->Change->Leaves(range.Box(this->lattice), parent, change))
      {
        this->TakeBlocks(range, region);
        return false;
      }
      return region.isOwn || range.Longest() > ContourBlock::Size ||
        this->IsBesideOwn(range.low, ContourBlock::Size);
    },
    [&](const CellRange& range, const FieldScope& scope, const ChangeScope&)
    {
      progress(fraction);
      ContourBlock block(this->field, this->lattice, this->Crossing, range, scope);
      if (!block.keys.empty() || !block.cells.empty())
      {
        region.blocks.push_back(std::move(block));
      }
    });
  region.blocks.shrink_to_fit();
  region.scope = {};
  region.before = {};
  region.change = {};
}

}
