// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/DelaunayDisparity.h"

#include "Common/Error.h"
#include "Disparity/DisparitySurface.h"
#include "Sharing/MakeAll.h"
#include "Sharing/ViewBytes.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

void DelaunayDisparityOptions::Check() const
{
  if (!(this->tolerance >= 0))
  {
    throw Error("The tolerance of the minimum disparity constraint must not be negative.");
  }
  if (!(this->leastCotangents <= 0))
  {
    throw Error("The sum of cotangents below which an edge is flipped must not be positive.");
  }
  this->partners.Check();
}

namespace
{

// Projects a point into a view. False where the camera does not see it.
bool Sight(const Camera& camera, const Eigen::Vector3d& point, Sighting& sighting)
{
  const double depth = camera.Depth(point);
  if (!(depth > 0)) // also where it is not a number
  {
    return false;
  }
  const Eigen::Vector2d pixel = camera.Project(point);
  if (!std::isfinite(1 / depth) || !camera.Sees(pixel))
  {
    return false;
  }
  sighting.pixel = Pixel(pixel.x(), pixel.y());
  sighting.disparity = 1 / depth;
  return true;
}

// The view's edges, as pairs of visible features: those whose two ends are visible.
std::vector<std::array<int, 2>> SightedEdges(const View& view, const std::vector<int>& sighted)
{
  std::vector<std::array<int, 2>> edges;
  for (const auto& [a, b] : view.edges)
  {
    if (sighted[a] >= 0 && sighted[b] >= 0)
    {
      edges.push_back({ sighted[a], sighted[b] });
    }
  }
  return edges;
}

// Where points of other views come from.
struct OtherFeatures
{
  const FeatureCloud& cloud;
  const std::vector<int>& partners; // views
};

// The other views' features that are visible in a view.
std::vector<SightedFeature> FeaturesOfOthers(
  const Camera& camera, int index, const OtherFeatures& features, const CancellationFlag& stop)
{
  std::vector<SightedFeature> others;
  SightedFeature sighting;
  features.cloud.VisitSeen(camera, features.partners,
    [&](const FeatureCloud::Feature& feature)
    {
      ThrowIfCancelled(stop);
      if (feature.sourceView != index && Sight(camera, feature.point, sighting))
      {
        sighting.feature = &feature;
        others.push_back(sighting);
      }
    });
  return others;
}

template <typename Triangulation>
DisparityMap TriangulateWith(const View& view, int index, const OtherFeatures& features,
  const DelaunayDisparityOptions& options, const CancellationFlag& stop)
{
  std::vector<SightedPoint> own;
  std::vector<int> sighted(view.points.size(), -1);
  SightedPoint sighting;
  sighting.sourceView = index;
  own.reserve(view.points.size());
  for (std::size_t i = 0; i < view.points.size(); ++i)
  {
    if (Sight(view.camera, view.points[i], sighting))
    {
      sighted[i] = static_cast<int>(own.size());
      sighting.point = view.points[i];
      sighting.deviation = view.deviations.empty() ? 0 : view.deviations[i];
      own.push_back(sighting);
    }
  }
  DisparitySurface<Triangulation> surface(view);
  surface.TriangulateFeatures(own, stop);
  const std::vector<std::array<int, 2>> edges = SightedEdges(view, sighted);
  surface.KeepEdges(edges);
  if (options.minimumDisparity)
  {
    surface.AddCandidates(FeaturesOfOthers(view.camera, index, features, stop), stop);
    surface.EnforceMinimumDisparity(options.tolerance, stop);
  }
  if (options.spatialFlips)
  {
    surface.FlipEdges(options.leastCotangents, edges, stop);
  }
  DisparityMap map;
  map.name = view.name;
  map.imageFile = view.imageFile;
  map.camera = view.camera;
  surface.Fill(map);
  return map;
}

DisparityMap TriangulateOne(const View& view, int index, const OtherFeatures& features,
  const DelaunayDisparityOptions& options, const CancellationFlag& stop)
{
  return options.keepEdges && !view.edges.empty()
    ? TriangulateWith<ConstrainedTriangulation>(view, index, features, options, stop)
    : TriangulateWith<PlainTriangulation>(view, index, features, options, stop);
}

}

DisparityMap TriangulateView(
  const std::vector<View>& views, std::size_t index, const DelaunayDisparityOptions& options)
{
  options.Check();
  const bool hasOthers = options.minimumDisparity;
  const FeatureCloud cloud(hasOthers ? views : std::vector<View>());
  const std::vector<int> partners =
    hasOthers ? PartnerViews(views, options.partners)[index] : std::vector<int>();
  return TriangulateOne(
    views[index], static_cast<int>(index), { cloud, partners }, options, NeverCancelled);
}

std::vector<DisparityMap> TriangulateViews(const std::vector<View>& views,
  const FeatureCloud& cloud, const DelaunayDisparityOptions& options,
  const ParallelFor& parallelFor, const Progress& progress)
{
  options.Check();
  std::vector<double> work;
  std::transform(views.begin(), views.end(), std::back_inserter(work),
    [](const View& view) { return static_cast<double>(view.points.size()); });
  const std::vector<std::vector<int>> partners = options.minimumDisparity
    ? PartnerViews(views, options.partners)
    : std::vector<std::vector<int>>(views.size());
  return MakeAll<DisparityMap>(work, parallelFor, progress,
    [&](std::size_t v, const CancellationFlag& stop) {
      return TriangulateOne(views[v], static_cast<int>(v), { cloud, partners[v] }, options, stop);
    });
}

std::vector<DisparityMap> TriangulateViews(const std::vector<View>& views,
  const DelaunayDisparityOptions& options, const ParallelFor& parallelFor, const Progress& progress)
{
  const FeatureCloud cloud(options.minimumDisparity ? views : std::vector<View>());
  return TriangulateViews(views, cloud, options, parallelFor, progress);
}

}
