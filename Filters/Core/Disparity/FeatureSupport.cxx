// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/FeatureSupport.h"

#include "Common/Error.h"
#include "Common/GroupedLists.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

namespace
{

// Features sorted into square cells as wide as the radius, so that neighbours lie in 3x3 cells.
class CellGrid
{
public:
  CellGrid(const std::vector<Eigen::Vector2d>& pixels, const std::vector<double>& disparity,
    double cellSize, const Camera& camera)
    : CellSize(std::max({ cellSize, camera.width / 4096.0, camera.height / 4096.0 }))
    , Columns(static_cast<int>(camera.width / this->CellSize) + 1)
    , Rows(static_cast<int>(camera.height / this->CellSize) + 1)
    , Members(static_cast<std::size_t>(this->Columns) * this->Rows,
        [&](const auto& add)
        {
          for (std::size_t i = 0; i < pixels.size(); ++i)
          {
            if (disparity[i] > 0)
            {
              const std::size_t row = this->Row(pixels[i].y());
              add(row * this->Columns + this->Column(pixels[i].x()), i);
            }
          }
        })
  {
  }

  template <typename Visitor>
  void VisitNeighborhood(const Eigen::Vector2d& pixel, Visitor&& visit) const
  {
    const int row = this->Row(pixel.y()), column = this->Column(pixel.x());
    for (int r = std::max(0, row - 1); r <= std::min(this->Rows - 1, row + 1); ++r)
    {
      const std::size_t first = static_cast<std::size_t>(r) * this->Columns;
      const auto members = this->Members.Between(
        first + std::max(0, column - 1), first + std::min(this->Columns - 1, column + 1) + 1);
      std::for_each(members.begin(), members.end(), visit);
    }
  }

private:
  // Features outside the image, which is allowed, share the cells on its border.
  static int Clamp(double cell, int count)
  {
    return cell > 0 ? static_cast<int>(std::min(cell, count - 1.0)) : 0;
  }
  int Row(double y) const { return Clamp(y / this->CellSize, this->Rows); }
  int Column(double x) const { return Clamp(x / this->CellSize, this->Columns); }

  double CellSize;
  int Columns;
  int Rows;
  GroupedLists<std::size_t> Members; // features per cell
};

// 0 where the feature cannot be used: not finite, or not in front of the camera.
std::vector<double> UsableDisparities(const View& view)
{
  std::vector<double> disparity(view.points.size(), 0.0);
  for (std::size_t i = 0; i < disparity.size(); ++i)
  {
    const double depth = view.camera.Depth(view.points[i]);
    if (std::isfinite(depth) && depth > 0 && view.imagePoints[i].allFinite())
    {
      disparity[i] = 1 / depth;
    }
  }
  return disparity;
}

// Of features spread evenly over the box that holds them.
double MeanSpacing(const View& view, const std::vector<double>& disparity)
{
  Eigen::AlignedBox2d box;
  int count = 0;
  for (std::size_t i = 0; i < disparity.size(); ++i)
  {
    if (disparity[i] > 0)
    {
      box.extend(view.imagePoints[i]);
      ++count;
    }
  }
  return count > 0 ? std::sqrt(box.sizes().prod() / count) : 0;
}

}

void FeatureSupportOptions::Check() const
{
  if (!(this->spacings >= 0))
  {
    throw Error("The radius of a neighbourhood in spacings cannot be negative.");
  }
  if (!(this->radius > 0))
  {
    throw Error("The radius of a feature's neighbourhood must be positive.");
  }
  if (this->minimumNeighbors < 0 || !(this->disparityTolerance >= 0))
  {
    throw Error("The least number of neighbours and the disparity tolerance cannot be negative.");
  }
}

std::vector<int> CountSupport(const View& view, const FeatureSupportOptions& options)
{
  options.Check();
  const std::vector<double> disparity = UsableDisparities(view);
  const double radius = options.spacings > 0
    ? std::max(options.spacings * MeanSpacing(view, disparity), 1.0)
    : options.radius;
  const CellGrid grid(view.imagePoints, disparity, radius, view.camera);
  std::vector<int> support(view.points.size(), 0);
  for (std::size_t i = 0; i < support.size(); ++i)
  {
    if (disparity[i] <= 0)
    {
      support[i] = -1;
      continue;
    }
    grid.VisitNeighborhood(view.imagePoints[i],
      [&](std::size_t j)
      {
        const bool near =
          (view.imagePoints[i] - view.imagePoints[j]).squaredNorm() <= radius * radius;
        const bool agrees = std::abs(disparity[i] - disparity[j]) <=
          options.disparityTolerance * std::max(disparity[i], disparity[j]);
        support[i] += j != i && near && agrees;
      });
  }
  return support;
}

}
