// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/OutlierRejection.h"

#include "Common/Error.h"
#include "Common/GroupedLists.h"
#include "Common/Median.h"
#include "Common/ParallelForWithProgress.h"
#include "Disparity/FeatureCloud.h"
#include "Disparity/OverlappingViews.h"
#include "Disparity/ViolatedTriangles.h"
#include "ViewFreespace/ViewFreespace.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

// Thresholds in units of the noise: features that differ by less agree.
constexpr double Agreement = 4;
constexpr double LeastDisagreement = 10;

// In units of the median over the view.
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
  const DisparityMap& map, const OutlierRejectionOptions& options, const CancellationFlag& stop)
{
  const double focalLength = std::sqrt(std::abs(map.camera.K(0, 0) * map.camera.K(1, 1)));
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
    if (static_cast<int>(differences.size()) >= options.neighbors)
    {
      std::sort(differences.begin(), differences.end());
      lack[i] = options.neighbors > 0 ? differences[options.neighbors - 1] : 0.0;
    }
  }
  return lack;
}

// Per point of a map whether enough of its neighbours have a similar disparity. The threshold
// depends on the view: where features are sparse, disparities differ more from one to the next.
std::vector<char> SupportedPoints(
  const DisparityMap& map, const OutlierRejectionOptions& options, const CancellationFlag& stop)
{
  const std::vector<double> lack = LackOfSupport(map, options, stop);
  const double typical = MedianOr(lack, 0.0);
  const double most = std::max(LeastDisagreement * options.noise, Untypical * typical);
  std::vector<char> supported(lack.size());
  std::transform(lack.begin(), lack.end(), supported.begin(),
    [most](double value) { return std::isfinite(value) && value <= most; });
  return supported;
}

// Whether too many of the other views have a point in their free space.
bool IsSeenThrough(const Vector3d& point, const std::vector<int>& others,
  const std::vector<std::unique_ptr<ViewFreespace>>& freespaces,
  const std::vector<DisparityMap>& maps, const OutlierRejectionOptions& options)
{
  int through = 0, agreeing = 0;
  for (int v : others)
  {
    const ViewFreespace::Sample sample = freespaces[v]->At(point);
    const double room = Agreement * options.noise * maps[v].camera.Depth(point);
    through += sample.triangle >= 0 && sample.value > room;
    agreeing += sample.triangle >= 0 && std::abs(sample.value) <= room;
  }
  return through >= options.seeThroughViews && through > agreeing;
}

}

void OutlierRejectionOptions::Check() const
{
  if (!(this->noise > 0) || !std::isfinite(this->noise))
  {
    throw Error("The relative noise of the features' depth must be positive.");
  }
  if (this->neighbors < 0 || this->nearest < 1 || this->seeThroughViews < 0 ||
    this->violatingFeatures < 0)
  {
    throw Error("The numbers of neighbours, views and features that test for outliers are out of "
                "range.");
  }
  if (!(this->steepestAngle >= 0 && this->steepestAngle < 90))
  {
    throw Error("The steepest angle between neighbours must be in [0, 90) degrees.");
  }
}

namespace
{

using Flags = std::vector<std::vector<char>>; // per view, per point of its map

// The points of the maps that passed the tests so far, as the features of views.
std::vector<View> PassedViews(const std::vector<DisparityMap>& maps, const Flags& passed)
{
  std::vector<View> views(maps.size());
  for (std::size_t v = 0; v < maps.size(); ++v)
  {
    for (std::size_t p = 0; p < maps[v].points.size(); ++p)
    {
      if (passed[v][p])
      {
        views[v].points.push_back(maps[v].points[p]);
      }
    }
  }
  return views;
}

// From flags per point of the map to flags per feature of the view. The map has the view's features
// in their order, but not all of them.
std::vector<char> OfFeatures(
  const View& view, const DisparityMap& map, const std::vector<char>& passed)
{
  std::vector<char> accepted(view.points.size(), 0);
  std::size_t p = 0;
  for (std::size_t i = 0; i < view.points.size() && p < map.points.size(); ++i)
  {
    if (view.points[i] == map.points[p])
    {
      accepted[i] = passed[p++];
    }
  }
  return accepted;
}

}

std::vector<std::vector<char>> AcceptedFeatures(const std::vector<View>& views,
  const std::vector<DisparityMap>& maps, const OutlierRejectionOptions& options,
  const ParallelFor& parallelFor, const Progress& progress)
{
  options.Check();
  const bool asksOthers = options.seeThroughViews > 0 || options.violatingFeatures > 0;
  std::vector<std::unique_ptr<ViewFreespace>> freespaces(maps.size());
  Flags supported(maps.size()), accepted(maps.size());
  std::vector<double> work;
  std::transform(maps.begin(), maps.end(), std::back_inserter(work),
    [](const DisparityMap& map) { return static_cast<double>(map.points.size()); });
  ParallelForWithProgress(work, parallelFor, progress.Part(0.0, 0.5),
    [&](std::size_t v, const CancellationFlag& stop)
    {
      freespaces[v] = asksOthers ? std::make_unique<ViewFreespace>(maps[v], stop) : nullptr;
      supported[v] = SupportedPoints(maps[v], options, stop);
    });
  const FeatureCloud cloud(
    options.violatingFeatures > 0 ? PassedViews(maps, supported) : std::vector<View>());
  const auto overlapping =
    options.seeThroughViews > 0 ? OverlappingViews(maps) : std::vector<std::vector<int>>();
  ParallelForWithProgress(work, parallelFor, progress.Part(0.5, 1.0),
    [&](std::size_t v, const CancellationFlag& stop)
    {
      std::vector<char> passed = supported[v], behind(maps[v].points.size(), 0);
      if (options.violatingFeatures > 0)
      {
        behind = PointsBehindViolations(maps[v],
          ViolatedTriangles(maps[v], *freespaces[v], cloud, static_cast<int>(v),
            options.violatingFeatures, Agreement * options.noise));
      }
      for (std::size_t p = 0; p < passed.size(); ++p)
      {
        ThrowIfCancelled(stop);
        passed[p] = passed[p] && !behind[p] &&
          (options.seeThroughViews == 0 ||
            !IsSeenThrough(maps[v].points[p], overlapping[v], freespaces, maps, options));
      }
      accepted[v] = OfFeatures(views[v], maps[v], passed);
    });
  return accepted;
}

std::vector<View> RejectOutliers(const std::vector<View>& views,
  const std::vector<DisparityMap>& maps, const OutlierRejectionOptions& options,
  const ParallelFor& parallelFor, const Progress& progress)
{
  const std::vector<std::vector<char>> accepted =
    AcceptedFeatures(views, maps, options, parallelFor, progress);
  std::vector<View> kept = views;
  for (std::size_t v = 0; v < views.size(); ++v)
  {
    if (std::count(accepted[v].begin(), accepted[v].end(), 1) < 3)
    {
      continue;
    }
    kept[v].points.clear();
    kept[v].imagePoints.clear();
    kept[v].edges.clear();
    kept[v].deviations.clear();
    std::vector<int> newIndex(views[v].points.size(), -1);
    for (std::size_t i = 0; i < views[v].points.size(); ++i)
    {
      if (accepted[v][i])
      {
        newIndex[i] = static_cast<int>(kept[v].points.size());
        kept[v].points.push_back(views[v].points[i]);
        kept[v].imagePoints.push_back(views[v].imagePoints[i]);
        if (!views[v].deviations.empty())
        {
          kept[v].deviations.push_back(views[v].deviations[i]);
        }
      }
    }
    for (const auto& [a, b] : views[v].edges)
    {
      if (newIndex[a] >= 0 && newIndex[b] >= 0)
      {
        kept[v].edges.push_back({ newIndex[a], newIndex[b] });
      }
    }
  }
  return kept;
}

}
