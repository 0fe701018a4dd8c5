// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/Outliers/Outliers.h"

#include "Common/ParallelForWithProgress.h"
#include "Disparity/FeatureCloud.h"
#include "Disparity/Outliers/RadiusSupport.h"
#include "Disparity/Outliers/SharedFeatures.h"
#include "Disparity/Outliers/TriangulationSupport.h"
#include "Disparity/Outliers/ViolatedTriangles.h"
#include "Disparity/OverlappingViews.h"
#include "Sharing/MakeAll.h"
#include "ViewFreespace/ViewFreespace.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

// Whether too many of the other views have a point in their free space.
bool IsSeenThrough(const Vector3d& point, const std::vector<int>& others,
  const std::vector<std::unique_ptr<ViewFreespace>>& freespaces,
  const std::vector<DisparityMap>& maps, const OutlierOptions& options)
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

// A view that would keep less than a triangle keeps all.
void KeepTriangles(Flags& accepted)
{
  for (std::vector<char>& view : accepted)
  {
    if (std::count(view.begin(), view.end(), 1) < 3)
    {
      std::fill(view.begin(), view.end(), 1);
    }
  }
}

std::vector<View> KeptFeatures(const std::vector<View>& views, const Flags& accepted)
{
  std::vector<View> kept = views;
  for (std::size_t v = 0; v < views.size(); ++v)
  {
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

// Which features need no support.
class ConfirmedFeatures
{
public:
  ConfirmedFeatures(const std::vector<View>& views, const OutlierOptions& options)
    : Shared(options.support > 0 && options.sharingViews > 0 ? views : std::vector<View>())
    , Least(options.sharingViews)
  {
  }

  bool Has(const Vector3d& point) const
  {
    return this->Least > 0 && this->Shared.ViewsWith(point) >= this->Least;
  }

private:
  SharedFeatures Shared;
  int Least;
};

// Whether features have enough support within the radius.
Flags SupportedWithinRadius(const std::vector<View>& views, const OutlierOptions& options,
  const ParallelFor& parallelFor, const Progress& progress)
{
  constexpr double least = 1.0; // pixels
  std::vector<double> work;
  std::transform(views.begin(), views.end(), std::back_inserter(work),
    [](const View& view) { return static_cast<double>(view.points.size()); });
  const ConfirmedFeatures confirmed(views, options);
  Flags accepted = MakeAll<std::vector<char>>(work, parallelFor, progress,
    [&](std::size_t v, const CancellationFlag&)
    {
      std::vector<char> flags;
      const double radius = std::max(options.radius * MeanSpacing(views[v]), least);
      for (const int support : CountSupport(views[v], radius, options.tolerance))
      {
        // Not finite or not in front of the camera: -1.
        flags.push_back(support >= options.support ||
          (support >= 0 && confirmed.Has(views[v].points[flags.size()])));
      }
      return flags;
    });
  KeepTriangles(accepted);
  return accepted;
}

// The tests that need the views' own maps.
Flags AcceptedInMaps(const std::vector<View>& views, const std::vector<DisparityMap>& maps,
  const OutlierOptions& options, const ParallelFor& parallelFor, const Progress& progress)
{
  std::vector<std::unique_ptr<ViewFreespace>> freespaces(maps.size());
  const ConfirmedFeatures confirmed(views, options);
  Flags supported(maps.size());
  std::vector<double> work;
  std::transform(maps.begin(), maps.end(), std::back_inserter(work),
    [](const DisparityMap& map) { return static_cast<double>(map.points.size()); });
  ParallelForWithProgress(work, parallelFor, progress.Part(0.0, 0.5),
    [&](std::size_t v, const CancellationFlag& stop)
    {
      freespaces[v] =
        options.AsksOthers() ? std::make_unique<ViewFreespace>(maps[v], stop) : nullptr;
      supported[v] = SupportedPoints(maps[v], options, stop);
      std::transform(supported[v].begin(), supported[v].end(), maps[v].points.begin(),
        supported[v].begin(),
        [&](char isSupported, const Vector3d& point) -> char
        { return isSupported || confirmed.Has(point); });
    });
  const FeatureCloud cloud(
    options.violatingFeatures > 0 ? PassedViews(maps, supported) : std::vector<View>());
  const auto overlapping =
    options.seeThroughViews > 0 ? OverlappingViews(maps) : std::vector<std::vector<int>>();
  Flags accepted = MakeAll<std::vector<char>>(work, parallelFor, progress.Part(0.5, 1.0),
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
      return OfFeatures(views[v], maps[v], passed);
    });
  KeepTriangles(accepted);
  return accepted;
}

}

std::vector<std::vector<char>> AcceptedFeatures(const std::vector<View>& views,
  const OutlierOptions& options, const DelaunayDisparityOptions& triangulation,
  const ParallelFor& parallelFor, const Progress& progress)
{
  options.Check();
  if (!options.IsOn())
  {
    Flags all;
    std::transform(views.begin(), views.end(), std::back_inserter(all),
      [](const View& view) { return std::vector<char>(view.points.size(), 1); });
    return all;
  }
  if (options.radius > 0 && options.support > 0)
  {
    Flags accepted = SupportedWithinRadius(views, options, parallelFor, progress.Part(0.0, 0.3));
    if (options.AsksOthers())
    {
      OutlierOptions others = options;
      others.support = 0;
      const Flags rest = AcceptedFeatures(
        KeptFeatures(views, accepted), others, triangulation, parallelFor, progress.Part(0.3, 1.0));
      for (std::size_t v = 0; v < views.size(); ++v)
      {
        auto next = rest[v].begin();
        for (char& flag : accepted[v])
        {
          flag = flag && *next++;
        }
      }
    }
    return accepted;
  }
  DelaunayDisparityOptions own = triangulation;
  own.minimumDisparity = false;
  const std::vector<DisparityMap> maps =
    TriangulateViews(views, own, parallelFor, progress.Part(0.0, 0.55));
  return AcceptedInMaps(views, maps, options, parallelFor, progress.Part(0.55, 1.0));
}

std::vector<View> RejectOutliers(const std::vector<View>& views, const OutlierOptions& options,
  const DelaunayDisparityOptions& triangulation, const ParallelFor& parallelFor,
  const Progress& progress)
{
  return KeptFeatures(
    views, AcceptedFeatures(views, options, triangulation, parallelFor, progress));
}

}
