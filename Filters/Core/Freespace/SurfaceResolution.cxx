// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/SurfaceResolution.h"

#include "Common/Error.h"
#include "Common/Median.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace freespace
{

void ResolutionOptions::Check() const
{
  if (!(this->cell > 0 && this->pixels > 0))
  {
    throw Error("The side of a cell must be above 0.");
  }
  if (!(this->fewestCells >= 2 && this->mostCells >= this->fewestCells))
  {
    throw Error("A lattice has at least 2 cells, and at most no fewer than at least.");
  }
}

double CellSide(const std::vector<ViewFeatures>& views, const Eigen::AlignedBox3d& box,
  const ResolutionOptions& options)
{
  options.Check();
  std::vector<double> sides;
  for (const ViewFeatures& view : views)
  {
    const double focal = view.camera.FocalLength();
    const double pixels = std::max(options.cell * view.spacing, options.pixels);
    for (const Eigen::Vector3d& point : view.points)
    {
      const double depth = view.camera.Depth(point);
      if (depth > 0 && focal > 0 && box.contains(point))
      {
        sides.push_back(pixels * depth / focal);
      }
    }
  }
  return MedianOr(std::move(sides), 0.0);
}

int CellsAlong(const Eigen::AlignedBox3d& box, double cellSide, const ResolutionOptions& options)
{
  const double longest = box.isEmpty() ? 0 : box.sizes().maxCoeff();
  const double cells = cellSide > 0 ? std::ceil(longest / cellSide) : 0;
  return static_cast<int>(std::clamp<double>(cells, options.fewestCells, options.mostCells));
}

}
