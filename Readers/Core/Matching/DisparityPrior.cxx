// SPDX-License-Identifier: BSD-3-Clause
#include "Matching/DisparityPrior.h"

#include "Common/Median.h"

#include <algorithm>

namespace freespace
{

DisparityPrior::DisparityPrior(
  const std::vector<Eigen::Vector2d>& pixels, const std::vector<double>& disparities)
{
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& pixel : pixels)
  {
    corner = corner.cwiseMax(pixel);
  }
  this->Columns = static_cast<int>(corner.x() / CellSize) + 1;
  this->Rows = static_cast<int>(corner.y() / CellSize) + 1;
  std::vector<std::vector<double>> cells(static_cast<std::size_t>(this->Columns) * this->Rows);
  for (std::size_t i = 0; i < pixels.size(); ++i)
  {
    cells[this->CellOf(pixels[i])].push_back(disparities[i]);
  }
  for (std::vector<double>& cell : cells)
  {
    this->Disparity.push_back(MedianOr(std::move(cell), 0.0));
  }
  this->SpreadToEmptyCells();
}

double DisparityPrior::At(const Eigen::Vector2d& pixel) const
{
  return this->Disparity[this->CellOf(pixel)];
}

int DisparityPrior::CellOf(const Eigen::Vector2d& pixel) const
{
  const auto clamp = [](double cell, int count)
  { return static_cast<int>(std::clamp(cell, 0.0, count - 1.0)); };
  return clamp(pixel.y() / CellSize, this->Rows) * this->Columns +
    clamp(pixel.x() / CellSize, this->Columns);
}

// Breadth-first search from the cells that have a value.
void DisparityPrior::SpreadToEmptyCells()
{
  std::vector<int> queue;
  for (int cell = 0; cell < static_cast<int>(this->Disparity.size()); ++cell)
  {
    if (this->Disparity[cell] > 0)
    {
      queue.push_back(cell);
    }
  }
  for (std::size_t next = 0; next < queue.size(); ++next)
  {
    const int cell = queue[next], column = cell % this->Columns, row = cell / this->Columns;
    const auto spread = [&](bool inside, int neighbor)
    {
      if (inside && this->Disparity[neighbor] == 0)
      {
        this->Disparity[neighbor] = this->Disparity[cell];
        queue.push_back(neighbor);
      }
    };
    spread(column > 0, cell - 1);
    spread(column + 1 < this->Columns, cell + 1);
    spread(row > 0, cell - this->Columns);
    spread(row + 1 < this->Rows, cell + this->Columns);
  }
}

}
