// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/Outliers/RadiusSupport.h"

#include "Common/GroupedLists.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

namespace
{

constexpr int mostSupport = 1000;
constexpr int mostTests = 16000; // of distances, for a feature and a cell

// Features sorted into square cells, and in a cell by their disparity: those of one cell lie within the
// radius of each other, and neighbours within the 5x5 cells about one.
class CellGrid
{
public:
  CellGrid(const std::vector<Eigen::Vector2d>& pixels, const std::vector<double>& disparity,
    double radius, const Camera& camera)
    : Pixels(pixels)
    , Disparity(disparity)
    , Radius(radius)
    , CellSize(std::max({ radius / std::sqrt(2.0), camera.width / 4096.0, camera.height / 4096.0 }))
    , Reach(radius <= this->CellSize ? 1 : 2)
    , Columns(static_cast<int>(camera.width / this->CellSize) + 1)
    , Rows(static_cast<int>(camera.height / this->CellSize) + 1)
    , Order(ByDisparity(disparity))
    , Members(static_cast<std::size_t>(this->Columns) * this->Rows,
        [&](const auto& add)
        {
          for (std::size_t i : this->Order)
          {
            add(this->CellOf(pixels[i]), i);
          }
        })
  {
  }

  // How many features within the radius agree with one's disparity, itself among them. Counts in its own
  // cell, which may be many, take a binary search, and those in others end at `most`.
  int Count(std::size_t feature, double tolerance, int most) const
  {
    const int row = this->Row(this->Pixels[feature].y());
    const int column = this->Column(this->Pixels[feature].x());
    int count = 0;
    for (int ring = 0; ring <= this->Reach; ++ring)
    {
      for (int r = row - ring; r <= row + ring; ++r)
      {
        const int step = std::abs(r - row) == ring ? 1 : 2 * ring;
        for (int c = column - ring; c <= column + ring; c += step)
        {
          if (r >= 0 && r < this->Rows && c >= 0 && c < this->Columns)
          {
            count += this->CountIn(
              static_cast<std::size_t>(r) * this->Columns + c, feature, tolerance, most - count);
          }
        }
      }
    }
    return count;
  }

private:
  static std::vector<std::size_t> ByDisparity(const std::vector<double>& disparity)
  {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < disparity.size(); ++i)
    {
      if (disparity[i] > 0)
      {
        order.push_back(i);
      }
    }
    std::stable_sort(order.begin(), order.end(),
      [&disparity](std::size_t a, std::size_t b) { return disparity[a] < disparity[b]; });
    return order;
  }

  int CountIn(std::size_t cell, std::size_t feature, double tolerance, int most) const
  {
    const auto members = this->Members[cell];
    const double own = this->Disparity[feature];
    const auto agrees = [&](std::size_t j)
    {
      const double other = this->Disparity[j];
      return std::abs(own - other) <= tolerance * std::max(own, other);
    };
    const auto begin = std::partition_point(members.begin(), members.end(),
      [&](std::size_t j) { return this->Disparity[j] < own && !agrees(j); });
    const auto end = std::partition_point(
      begin, members.end(), [&](std::size_t j) { return this->Disparity[j] <= own || agrees(j); });
    const bool isOwn = cell == this->CellOf(this->Pixels[feature]);
    if (isOwn && this->AreNear(cell))
    {
      return static_cast<int>(end - begin);
    }
    int count = 0;
    for (auto j = begin; j < end && j - begin < mostTests && count < most; ++j)
    {
      count +=
        (this->Pixels[feature] - this->Pixels[*j]).squaredNorm() <= this->Radius * this->Radius;
    }
    return count;
  }

  // Whether all features of a cell lie within the radius of each other. Those outside the image share
  // the cells on its border.
  bool AreNear(std::size_t cell) const
  {
    const int row = static_cast<int>(cell / this->Columns);
    const int column = static_cast<int>(cell % this->Columns);
    return this->CellSize * std::sqrt(2.0) <= this->Radius * (1 + 1e-12) && row > 0 && column > 0 &&
      row < this->Rows - 1 && column < this->Columns - 1;
  }

  static int Clamp(double cell, int count)
  {
    return cell > 0 ? static_cast<int>(std::min(cell, count - 1.0)) : 0;
  }
  int Row(double y) const { return Clamp(y / this->CellSize, this->Rows); }
  int Column(double x) const { return Clamp(x / this->CellSize, this->Columns); }
  std::size_t CellOf(const Eigen::Vector2d& pixel) const
  {
    return static_cast<std::size_t>(this->Row(pixel.y())) * this->Columns + this->Column(pixel.x());
  }

  const std::vector<Eigen::Vector2d>& Pixels;
  const std::vector<double>& Disparity;
  double Radius;
  double CellSize;
  int Reach; // in cells
  int Columns;
  int Rows;
  std::vector<std::size_t> Order;
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

}

double MeanSpacing(const View& view)
{
  const std::vector<double> disparity = UsableDisparities(view);
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

std::vector<int> CountSupport(const View& view, double radius, double tolerance)
{
  const std::vector<double> disparity = UsableDisparities(view);
  const CellGrid grid(view.imagePoints, disparity, radius, view.camera);
  std::vector<int> support(view.points.size(), -1);
  for (std::size_t i = 0; i < support.size(); ++i)
  {
    if (disparity[i] > 0)
    {
      support[i] = grid.Count(i, tolerance, mostSupport) - 1;
    }
  }
  return support;
}

}
