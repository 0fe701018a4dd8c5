// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/Lattice/ContourEstimate.h"

#include "Common/Error.h"
#include "Contour/Lattice/ContourBlock.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace freespace
{

using Eigen::AlignedBox3d;

namespace
{

/// Number of boxes that are refined on each level.
constexpr std::size_t BoxesPerLevel = 1024;

/// Number of blocks of the last level that are contoured.
constexpr std::size_t BlocksTried = 512;

/// On finer lattices a surface has four times the triangles for every halved cell.
constexpr int CellsTried = 256;

using ScopedRange = std::pair<CellRange, FieldScope>;

/// An even selection of the boxes.
std::vector<ScopedRange> Thin(std::vector<ScopedRange> boxes, std::size_t wanted, double& weight)
{
  const std::size_t count = boxes.size();
  if (count <= wanted)
  {
    return boxes;
  }
  std::vector<ScopedRange> some;
  for (std::size_t i = 0; i < wanted; ++i)
  {
    some.push_back(std::move(boxes[i * count / wanted]));
  }
  weight *= static_cast<double>(count) / wanted;
  return some;
}

std::string Size(double megabytes)
{
  return std::to_string(std::llround(megabytes)) + " MiB"; // as the limit is given
}

}

double ContourMegabytes(double triangles, const ContourOptions& options, bool isSinglePrecision)
{
  // Per triangle: its corners, the offset that VTK's cells have, its labels; and its share of
  // the points and of the blocks that they come from: there are half as many.
  const double mesh = 12 + 4 + 5 + 0.5 * (isSinglePrecision ? 12 : 24);
  const double blocks = 0.5 * (8 + 3 + 5) + (options.sharp ? 0.5 * 12 + 2 : 0.0);
  return triangles * (mesh + blocks) / (1024 * 1024);
}

void CheckMemoryLimit(double triangles, const ContourOptions& options, bool isSinglePrecision)
{
  const double needed = ContourMegabytes(triangles, options, isSinglePrecision);
  if (options.memoryLimit > 0 && needed > options.memoryLimit)
  {
    throw Error("A surface of " + std::to_string(options.cells) + " cells takes about " +
      Size(needed) + " of memory, and the limit is " + Size(options.memoryLimit) +
      ": use fewer cells or a higher limit.");
  }
}

namespace
{

class Estimator
{
public:
  Estimator(const ContourField& field, const AlignedBox3d& bounds, int cells)
    : Bounds(bounds)
    , Field(field, bounds)
    , Lattice(bounds, cells)
  {
  }

  /// 0 when the field decided no box.
  double Triangles(const Progress& progress)
  {
    double weight = 1.0;
    std::vector<ScopedRange> boxes;
    boxes.push_back({ { { 0, 0, 0 }, this->Lattice.cells }, this->Field.Root() });
    while (!boxes.empty() && boxes.front().first.Longest() > ContourBlock::Size)
    {
      progress(0.0);
      boxes = Thin(this->MixedParts(boxes), BoxesPerLevel, weight);
    }
    boxes = Thin(std::move(boxes), BlocksTried, weight);
    CrossingOptions rough;
    rough.tolerance = 0.5; // positions do not matter here
    rough.exact = false;
    double triangles = 0.0;
    for (const auto& [range, scope] : boxes)
    {
      progress(0.0);
      triangles +=
        ContourBlock(this->Field, this->Lattice, rough, range, scope).NumberOfTriangles();
    }
    return this->IsDecided ? weight * triangles : 0.0;
  }

private:
  std::vector<ScopedRange> MixedParts(const std::vector<ScopedRange>& boxes)
  {
    std::vector<ScopedRange> mixed;
    for (const auto& [range, parent] : boxes)
    {
      for (const CellRange& part : range.Parts(ContourBlock::Size))
      {
        const AlignedBox3d box = part.Box(this->Lattice);
        FieldScope scope;
        if (this->Field.Classify(box, parent, scope) == BoxContent::Mixed)
        {
          mixed.push_back({ part, std::move(scope) });
        }
        else if (this->Bounds.contains(box))
        {
          this->IsDecided = true; // and not by the bounds
        }
      }
    }
    return mixed;
  }

  const AlignedBox3d Bounds;
  const BoundedField Field;
  const ContourLattice Lattice;
  bool IsDecided = false;
};

}

ContourEstimate EstimateContour(const ContourField& field, const AlignedBox3d& bounds,
  const ContourOptions& options, const Progress& progress)
{
  options.Check();
  ContourEstimate estimate;
  if (bounds.isEmpty())
  {
    return estimate;
  }
  const int cells = std::min(options.cells, CellsTried);
  const double scale = static_cast<double>(options.cells) / cells;
  estimate.triangles = scale * scale * Estimator(field, bounds, cells).Triangles(progress);
  estimate.megabytes =
    ContourMegabytes(estimate.triangles, options, SinglePrecisionSuffices(bounds, options));
  return estimate;
}

int CellsWithinMemory(const ContourField& field, const AlignedBox3d& bounds,
  const ContourOptions& options, const Progress& progress)
{
  // Ten times what surfaces have: what fits then need not be estimated.
  constexpr double manyTriangles = 60;
  const bool isSingle = SinglePrecisionSuffices(bounds, options);
  const double cells = options.cells;
  if (options.memoryLimit <= 0 ||
    ContourMegabytes(manyTriangles * cells * cells, options, isSingle) <= options.memoryLimit)
  {
    return options.cells;
  }
  const double needed = EstimateContour(field, bounds, options, progress).megabytes;
  // It is an estimate, to a tenth or two.
  const double share = 0.75 * options.memoryLimit / std::max(needed, 1e-9);
  return share >= 1 ? options.cells : std::max(2, static_cast<int>(cells * std::sqrt(share)));
}

}
