// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/RegionHull.h"

#include "Common/ParallelForWithProgress.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

using Eigen::AlignedBox3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

// The mean distance of features that lie evenly in the triangles.
double Spacing(const DisparityMap& map, std::size_t features)
{
  double area = 0;
  for (const auto& [a, b, c] : map.triangles)
  {
    const Vector2d ab = map.imagePoints[b] - map.imagePoints[a];
    const Vector2d ac = map.imagePoints[c] - map.imagePoints[a];
    area += 0.5 * std::abs(ab.x() * ac.y() - ab.y() * ac.x());
  }
  return features > 0 && std::isfinite(area) ? std::sqrt(area / features) : 0;
}

// Those of all features in the box that can be corners of its hull.
std::vector<Vector3d> OuterPointsIn(const std::vector<ViewFeatures>& views, const AlignedBox3d& box,
  const ParallelFor& parallelFor, const Progress& progress)
{
  std::vector<std::vector<Vector3d>> outer(views.size());
  ParallelForWithProgress(views.size(), parallelFor, progress,
    [&](std::size_t i, const CancellationFlag& stop)
    {
      std::vector<Vector3d> inside;
      for (const auto* points : { &views[i].points, &views[i].inserted })
      {
        std::copy_if(points->begin(), points->end(), std::back_inserter(inside),
          [&box](const Vector3d& point) { return box.contains(point); });
      }
      outer[i] = FeatureHull::OuterPoints(inside, stop);
    });
  std::vector<Vector3d> all;
  for (const auto& points : outer)
  {
    all.insert(all.end(), points.begin(), points.end());
  }
  return all;
}

}

ViewFeatures FeaturesOfMap(const DisparityMap& map, std::size_t index)
{
  ViewFeatures features;
  features.camera = map.camera;
  for (std::size_t i = 0; i < map.points.size(); ++i)
  {
    const bool isOwn = i >= map.sourceView.size() || map.sourceView[i] == static_cast<int>(index);
    if (map.points[i].allFinite() && (isOwn || map.sourceView[i] >= 0))
    {
      (isOwn ? features.points : features.inserted).push_back(map.points[i]);
    }
  }
  features.spacing = Spacing(map, features.points.size());
  return features;
}

RegionHull MakeRegionHull(const std::vector<ViewFeatures>& views, const RegionOptions& region,
  const ResolutionOptions& resolution, const HullMargin& margin, const ParallelFor& parallelFor,
  const Progress& progress)
{
  RegionHull result;
  result.region = FindRegion(views, region, parallelFor, progress.Part(0.0, 0.5));
  AlignedBox3d& box = result.region.box;
  // What other views brought in is theirs; where it is not, it counts as long as nothing is left out.
  if (result.region.beyond == 0 && region.mode != RegionOptions::Mode::Box)
  {
    for (const ViewFeatures& view : views)
    {
      for (const Vector3d& point : view.inserted)
      {
        box.extend(point);
      }
    }
  }
  result.cellSide = CellSide(views, box, resolution);
  result.cells = CellsAlong(box, result.cellSide, resolution);
  for (const ViewFeatures& view : views)
  {
    std::copy_if(view.points.begin(), view.points.end(), std::back_inserter(result.features),
      [&box](const Vector3d& point) { return box.contains(point); });
  }
  const std::vector<Vector3d> features =
    OuterPointsIn(views, box, parallelFor, progress.Part(0.5, 0.8));
  RunWithProgress(progress.Part(0.8, 1.0),
    [&](const CancellationFlag& stop)
    {
      const double distances = result.cellSide > 0
        ? box.sizes().maxCoeff() / result.cellSide * resolution.cell
        : result.cells;
      const double length =
        features.empty() ? 0.0 : margin(result.cells, distances) * box.diagonal().norm();
      result.hull = std::make_unique<FeatureHull>(features, length, stop);
    });
  return result;
}

}
