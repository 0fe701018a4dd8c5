// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/Outliers/TriangulationSupport.h"

#include "Common/GroupedLists.h"
#include "Common/Median.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

// In units of the noise, and of the median over the view.
constexpr double LeastDisagreement = 10;
constexpr double Untypical = 5;

// Finds the points of a map that are nearest to a point in the image, among those that at most two
// edges of the triangulation connect to it.
class Neighborhood
{
public:
  explicit Neighborhood(const DisparityMap& map);

  // The nearest points, at most `count`, nearest first; valid until the next call.
  const std::vector<int>& Nearest(int point, std::size_t count);

private:
  void Visit(int point, int center, std::size_t count);

  const DisparityMap& Map;
  GroupedLists<int> Neighbors;               // per point, those that it shares a triangle with
  std::vector<int> Stamp;                    // per point, the last search that visited it
  std::vector<std::pair<double, int>> Found; // the nearest so far, by their squared distance
  std::vector<int> Result;
};

Neighborhood::Neighborhood(const DisparityMap& map)
  : Map(map)
  , Neighbors(map.points.size(),
      [&map](const auto& add)
      {
        for (const auto& triangle : map.triangles)
        {
          for (int i = 0; i < 3; ++i)
          {
            add(triangle[i], triangle[(i + 1) % 3]);
            add(triangle[i], triangle[(i + 2) % 3]);
          }
        }
      })
  , Stamp(map.points.size(), -1)
{
  // Each neighbour once: two triangles share most edges.
  this->Neighbors.Filter(
    [this](std::size_t point, int neighbor)
    {
      return std::exchange(this->Stamp[neighbor], static_cast<int>(point)) !=
        static_cast<int>(point);
    });
  std::fill(this->Stamp.begin(), this->Stamp.end(), -1);
}

void Neighborhood::Visit(int point, int center, std::size_t count)
{
  if (this->Stamp[point] == center)
  {
    return;
  }
  this->Stamp[point] = center;
  const std::pair<double, int> found(
    (this->Map.imagePoints[point] - this->Map.imagePoints[center]).squaredNorm(), point);
  if (this->Found.size() == count)
  {
    if (!(found < this->Found.back()))
    {
      return;
    }
    this->Found.pop_back();
  }
  this->Found.insert(std::upper_bound(this->Found.begin(), this->Found.end(), found), found);
}

const std::vector<int>& Neighborhood::Nearest(int point, std::size_t count)
{
  this->Found.clear();
  this->Stamp[point] = point;
  for (const int neighbor : this->Neighbors[point])
  {
    this->Visit(neighbor, point, count);
  }
  for (const int neighbor : this->Neighbors[point])
  {
    for (const int next : this->Neighbors[neighbor])
    {
      this->Visit(next, point, count);
    }
  }
  this->Result.clear();
  std::transform(this->Found.begin(), this->Found.end(), std::back_inserter(this->Result),
    [](const auto& found) { return found.second; });
  return this->Result;
}

// For each point the relative difference in disparity to the k-th most similar of its nearest
// neighbours, k being the number that must agree. Infinite where fewer neighbours can lie on the
// same surface.
std::vector<double> LackOfSupport(
  const DisparityMap& map, const OutlierOptions& options, const CancellationFlag& stop)
{
  const double focalLength = map.camera.FocalLength();
  const double slope = std::tan(options.steepestAngle * M_PI / 180) / focalLength;
  Neighborhood neighborhood(map);
  std::vector<double> disparity;
  for (const Vector3d& point : map.points)
  {
    disparity.push_back(1 / map.camera.Depth(point));
  }
  std::vector<double> lack(map.points.size(), HUGE_VAL), differences;
  for (std::size_t i = 0; i < lack.size(); ++i)
  {
    ThrowIfCancelled(stop);
    differences.clear();
    for (int other : neighborhood.Nearest(static_cast<int>(i), options.nearest))
    {
      const double difference =
        std::abs(disparity[i] - disparity[other]) / std::max(disparity[i], disparity[other]);
      const double distance = (map.imagePoints[i] - map.imagePoints[other]).norm();
      const bool canJoin = difference <= Agreement * options.noise + slope * distance;
      differences.push_back(canJoin ? difference : HUGE_VAL);
    }
    if (static_cast<int>(differences.size()) >= options.support)
    {
      std::sort(differences.begin(), differences.end());
      lack[i] = options.support > 0 ? differences[options.support - 1] : 0.0;
    }
  }
  return lack;
}

}

std::vector<char> SupportedPoints(
  const DisparityMap& map, const OutlierOptions& options, const CancellationFlag& stop)
{
  const std::vector<double> lack = LackOfSupport(map, options, stop);
  const double typical = MedianOr(lack, 0.0);
  const double most = std::max(LeastDisagreement * options.noise, Untypical * typical);
  std::vector<char> supported(lack.size());
  std::transform(lack.begin(), lack.end(), supported.begin(),
    [most](double value) { return std::isfinite(value) && value <= most; });
  return supported;
}

}
