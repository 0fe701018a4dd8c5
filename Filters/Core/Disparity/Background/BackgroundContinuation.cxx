// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/Background/BackgroundContinuation.h"

#include "Common/Error.h"
#include "Common/ParallelForWithProgress.h"
#include "Disparity/Background/BridgedMap.h"
#include "Disparity/OverlappingViews.h"
#include "Sharing/MakeAll.h"
#include "Sharing/ViewBytes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <unordered_map>

namespace freespace
{

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

// Thresholds in units of the noise: to be seen through, to be a plane, to violate the minimum
// disparity constraint.
constexpr double SeeThrough = 4;
constexpr double Flatness = 2;
constexpr double SticksOut = 2;

// The place on a bridge that is tested, from its far side (0) to a near corner (1).
constexpr double NearSide = 0.8;

// Continues the background of one view, using the others.
class BackgroundContinuer
{
public:
  /// The maps of the overlapping views.
  using Others = std::vector<const BridgedMap*>;

  BackgroundContinuer(const BridgedMap& own, Others others, const BackgroundOptions& options)
    : Own(own)
    , OtherMaps(std::move(others))
    , Options(options)
    , Stamp(this->Own.map.points.size(), -1)
  {
  }

  DisparityMap Continue(
    const FeatureCloud& cloud, const std::vector<int>& partners, const CancellationFlag& stop);

private:
  struct SetBackBridge
  {
    std::size_t triangle;
    std::array<double, 3> disparity; // new ones at its corners
  };

  std::vector<SetBackBridge> RefutedBridges(const CancellationFlag& stop);
  std::vector<std::vector<Vector3d>> PointsInBridges(const FeatureCloud& cloud,
    const std::vector<int>& partners, const CancellationFlag& stop) const;
  double MiddleOfJump(std::size_t triangle) const;
  bool IsRefuted(std::size_t triangle) const;
  bool IsSeenThrough(const Vector3d& place) const;
  std::optional<double> SetBack(std::size_t triangle, int near);
  std::optional<double> PlaneAround(int far, int near);
  std::optional<double> FitPlane(int far, const Vector2d& pixel);
  std::vector<int> FarPointsAround(int far, double radius);
  double SurfaceBehind(const Vector2d& pixel, double from, double to) const;
  std::optional<double> Crossing(
    const BridgedMap& other, const Vector2d& pixel, double from, double to) const;
  bool IsViolated(std::size_t triangle, const std::array<double, 3>& disparity,
    const std::vector<Vector3d>& points) const;
  double DistanceToNearSide(std::size_t triangle, const Vector2d& pixel) const;

  const BridgedMap& Own;
  Others OtherMaps;
  const BackgroundOptions& Options;
  std::unordered_map<std::uint64_t, std::optional<double>> Planes; // by the ends of their edge
  std::vector<int> Stamp; // per point, the last search that visited it
  int Search = 0;
};

double BackgroundContinuer::MiddleOfJump(std::size_t triangle) const
{
  const auto [a, b, c] = this->Own.map.triangles[triangle];
  const auto [far, near] =
    std::minmax({ this->Own.disparity[a], this->Own.disparity[b], this->Own.disparity[c] });
  return (far + near) / 2;
}

// Whether other views see through the bridge close to each of its near corners. If they see through
// it only at a distance, the occluding edge was missed: it is somewhere within the bridge, with
// matter between it and the near corners.
bool BackgroundContinuer::IsRefuted(std::size_t triangle) const
{
  const auto& corner = this->Own.map.triangles[triangle];
  const double middle = this->MiddleOfJump(triangle);
  const auto isNear = [&](int point) { return this->Own.disparity[point] > middle; };
  Vector3d farSide = Vector3d::Zero();
  for (int point : corner)
  {
    farSide += isNear(point) ? Vector3d::Zero() : this->Own.map.points[point];
  }
  farSide /= static_cast<double>(3 - std::count_if(corner.begin(), corner.end(), isNear));
  return std::all_of(corner.begin(), corner.end(),
    [&](int point)
    {
      return !isNear(point) ||
        this->IsSeenThrough(NearSide * this->Own.map.points[point] + (1 - NearSide) * farSide);
    });
}

bool BackgroundContinuer::IsSeenThrough(const Vector3d& place) const
{
  int views = 0;
  for (std::size_t i = 0; i < this->OtherMaps.size() && views < this->Options.views; ++i)
  {
    const BridgedMap& other = *this->OtherMaps[i];
    const ViewFreespace::Sample sample = other.freespace.At(place);
    const double depth = other.map.camera.Depth(place);
    views += sample.triangle >= 0 && sample.value > SeeThrough * this->Options.noise * depth;
  }
  return views >= this->Options.views;
}

// Points around a far one, connected by triangles that are not bridges.
std::vector<int> BackgroundContinuer::FarPointsAround(int far, double radius)
{
  constexpr std::size_t enough = 200;
  const DisparityMap& map = this->Own.map;
  std::vector<int> found = { far };
  this->Stamp[far] = ++this->Search;
  for (std::size_t i = 0; i < found.size() && found.size() < enough; ++i)
  {
    for (const int triangle : this->Own.sound[found[i]])
    {
      for (int corner : map.triangles[triangle])
      {
        if (this->Stamp[corner] != this->Search &&
          (map.imagePoints[corner] - map.imagePoints[far]).norm() <= radius)
        {
          this->Stamp[corner] = this->Search;
          found.push_back(corner);
        }
      }
    }
  }
  return found;
}

// The disparity at a pixel of the plane fitted to the points around a far one, within the distance
// of the pixel; none where they are not coplanar.
std::optional<double> BackgroundContinuer::FitPlane(int far, const Vector2d& pixel)
{
  constexpr double leastRadius = 8; // pixels
  const DisparityMap& map = this->Own.map;
  const double radius = std::max(leastRadius, (pixel - map.imagePoints[far]).norm());
  const std::vector<int> points = this->FarPointsAround(far, radius);
  Eigen::MatrixX3d equations(points.size(), 3);
  Eigen::VectorXd disparity(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    equations.row(i) << (map.imagePoints[points[i]] - pixel).transpose() / radius, 1;
    disparity[i] = this->Own.disparity[points[i]];
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixX3d> solver(equations);
  if (points.size() < 3 || solver.rank() < 3)
  {
    return {};
  }
  const Vector3d plane = solver.solve(disparity);
  const double deviation =
    (equations * plane - disparity).norm() / std::sqrt(static_cast<double>(points.size()));
  return deviation <= Flatness * this->Options.noise * disparity.mean()
    ? std::optional<double>(plane[2])
    : std::nullopt;
}

// The same at a near point's pixel, cached: the two bridges of an edge both need it.
std::optional<double> BackgroundContinuer::PlaneAround(int far, int near)
{
  const std::uint64_t edge =
    static_cast<std::uint64_t>(far) << 32 | static_cast<std::uint32_t>(near);
  const auto [known, isNew] = this->Planes.try_emplace(edge);
  if (isNew)
  {
    known->second = this->FitPlane(far, this->Own.map.imagePoints[near]);
  }
  return known->second;
}

// The disparity where a viewing ray of this view, between two disparities, passes from the free
// space of another view into its surface. Bridges and the border of the map do not count.
std::optional<double> BackgroundContinuer::Crossing(
  const BridgedMap& other, const Vector2d& pixel, double from, double to) const
{
  constexpr double beyond = 1e-5; // of the way between the two
  const Camera& camera = this->Own.map.camera;
  const Vector3d first = camera.Unproject(pixel, 1 / from), last = camera.Unproject(pixel, 1 / to);
  std::optional<double> crossing;
  other.freespace.VisitFreeIntervals(first, last,
    [&](double, double end)
    {
      const Vector3d place = first + std::min(end + beyond, 1.0) * (last - first);
      const ViewFreespace::Sample behind = other.freespace.At(place);
      const bool isSurface = end < 1 && behind.triangle >= 0 && !other.isBridge[behind.triangle] &&
        std::abs(behind.value) < SeeThrough * this->Options.noise * other.map.camera.Depth(place);
      if (isSurface)
      {
        crossing = 1 / camera.Depth(first + end * (last - first));
      }
      return !isSurface;
    });
  return crossing;
}

// The disparity of the nearest surface of the other views between two disparities; 0: there is
// none.
double BackgroundContinuer::SurfaceBehind(const Vector2d& pixel, double from, double to) const
{
  std::optional<double> nearest;
  for (const BridgedMap* other : this->OtherMaps)
  {
    // Only a nearer crossing than those found before is of interest.
    const auto crossing = this->Crossing(*other, pixel, from, nearest.value_or(to));
    nearest = crossing ? crossing : nearest;
  }
  return nearest.value_or(0);
}

// The disparity of the background at a near corner of a bridge; none where it is not known.
std::optional<double> BackgroundContinuer::SetBack(std::size_t triangle, int near)
{
  const double middle = this->MiddleOfJump(triangle);
  const Vector2d& pixel = this->Own.map.imagePoints[near];
  double sum = 0, farthest = this->Own.disparity[near];
  int planes = 0;
  for (int corner : this->Own.map.triangles[triangle])
  {
    const double disparity = this->Own.disparity[corner];
    farthest = std::min(farthest, disparity);
    if (disparity <= middle)
    {
      if (const auto plane = this->PlaneAround(corner, near))
      {
        sum += std::max(*plane, disparity); // never farther than what is observed
        ++planes;
      }
    }
  }
  const double expected = planes > 0 ? sum / planes : farthest;
  const double behind = this->SurfaceBehind(pixel, (this->Own.disparity[near] + expected) / 2,
    expected * (1 - SeeThrough * this->Options.noise));
  if (behind > 0)
  {
    return behind;
  }
  return planes > 0 && expected < this->Own.disparity[near] ? std::optional<double>(expected)
                                                            : std::nullopt;
}

double BackgroundContinuer::DistanceToNearSide(std::size_t triangle, const Vector2d& pixel) const
{
  const DisparityMap& map = this->Own.map;
  const auto& corner = map.triangles[triangle];
  const double middle = this->MiddleOfJump(triangle);
  double distance = HUGE_VAL;
  for (int i = 0; i < 3; ++i)
  {
    const int a = corner[i], b = corner[(i + 1) % 3];
    if (this->Own.disparity[a] > middle)
    {
      const bool isEdge = this->Own.disparity[b] > middle;
      const Vector2d along =
        isEdge ? Vector2d(map.imagePoints[b] - map.imagePoints[a]) : Vector2d::Zero();
      const Vector2d offset = pixel - map.imagePoints[a];
      const double length = along.squaredNorm();
      const double s = length > 0 ? std::clamp(offset.dot(along) / length, 0.0, 1.0) : 0.0;
      distance = std::min(distance, (offset - s * along).norm());
    }
  }
  return distance;
}

// Whether a triangle with new disparities at its corners would violate the minimum disparity
// constraint.
bool BackgroundContinuer::IsViolated(std::size_t triangle, const std::array<double, 3>& disparity,
  const std::vector<Vector3d>& points) const
{
  const DisparityMap& map = this->Own.map;
  const auto& corner = map.triangles[triangle];
  const Vector2d& origin = map.imagePoints[corner[0]];
  Eigen::Matrix2d edges;
  edges << map.imagePoints[corner[1]] - origin, map.imagePoints[corner[2]] - origin;
  const Eigen::Matrix2d inverse = edges.inverse();
  return std::any_of(points.begin(), points.end(),
    [&](const Vector3d& point)
    {
      const Vector2d pixel = map.camera.Project(point);
      const Vector2d weight = inverse * (pixel - origin);
      const double surface = disparity[0] + weight.x() * (disparity[1] - disparity[0]) +
        weight.y() * (disparity[2] - disparity[0]);
      const double height = 1 / map.camera.Depth(point) - surface;
      return height > SticksOut * this->Options.noise * surface &&
        this->DistanceToNearSide(triangle, pixel) >= this->Options.edgeWidth;
    });
}

// The refuted bridges whose background is known.
std::vector<BackgroundContinuer::SetBackBridge> BackgroundContinuer::RefutedBridges(
  const CancellationFlag& stop)
{
  std::vector<SetBackBridge> refuted;
  for (std::size_t t = 0; t < this->Own.map.triangles.size(); ++t)
  {
    ThrowIfCancelled(stop);
    if (!this->Own.isBridge[t] || !this->IsRefuted(t))
    {
      continue;
    }
    SetBackBridge bridge{ t, {} };
    bool known = true;
    for (int i = 0; i < 3 && known; ++i)
    {
      const int corner = this->Own.map.triangles[t][i];
      bridge.disparity[i] = this->Own.disparity[corner];
      if (bridge.disparity[i] > this->MiddleOfJump(t))
      {
        const std::optional<double> background = this->SetBack(t, corner);
        known = background.has_value();
        bridge.disparity[i] = background.value_or(0);
      }
    }
    if (known)
    {
      refuted.push_back(bridge);
    }
  }
  return refuted;
}

// The features of views that project into bridges, by triangle.
std::vector<std::vector<Vector3d>> BackgroundContinuer::PointsInBridges(
  const FeatureCloud& cloud, const std::vector<int>& partners, const CancellationFlag& stop) const
{
  std::vector<std::vector<Vector3d>> points(this->Own.map.triangles.size());
  const BridgeMask mask(this->Own);
  cloud.VisitSeen(this->Own.map.camera, partners,
    [&](const FeatureCloud::Feature& feature)
    {
      ThrowIfCancelled(stop);
      if (mask.MayHold(this->Own.map.camera.Project(feature.point)))
      {
        const int triangle = this->Own.freespace.At(feature.point).triangle;
        if (triangle >= 0 && this->Own.isBridge[triangle])
        {
          points[triangle].push_back(feature.point);
        }
      }
    });
  return points;
}

DisparityMap BackgroundContinuer::Continue(
  const FeatureCloud& cloud, const std::vector<int>& partners, const CancellationFlag& stop)
{
  DisparityMap map = this->Own.map;
  std::vector<double> disparity = this->Own.disparity;
  std::vector<std::vector<int>> setBack(map.points.size()); // background points of each point
  const std::vector<std::vector<Vector3d>> points = this->PointsInBridges(cloud, partners, stop);
  for (const SetBackBridge& bridge : this->RefutedBridges(stop))
  {
    ThrowIfCancelled(stop);
    if (this->IsViolated(bridge.triangle, bridge.disparity, points[bridge.triangle]))
    {
      continue;
    }
    for (int i = 0; i < 3; ++i)
    {
      int& corner = map.triangles[bridge.triangle][i];
      const double wanted = bridge.disparity[i];
      if (wanted == disparity[corner])
      {
        continue;
      }
      // Adjacent bridges share a background point where their disparities agree.
      std::vector<int>& behind = setBack[corner];
      const auto shared = std::find_if(behind.begin(), behind.end(),
        [&](int other)
        { return std::abs(disparity[other] - wanted) <= this->Options.noise * wanted; });
      if (shared == behind.end())
      {
        const Vector2d pixel = map.imagePoints[corner];
        map.points.push_back(map.camera.Unproject(pixel, 1 / wanted));
        map.imagePoints.push_back(pixel);
        map.sourceView.push_back(-1);
        if (!map.deviations.empty())
        {
          map.deviations.push_back(0);
        }
        disparity.push_back(wanted);
        behind.push_back(static_cast<int>(map.points.size()) - 1);
        corner = behind.back();
      }
      else
      {
        corner = *shared;
      }
    }
  }
  return map;
}

}

void BackgroundOptions::Check() const
{
  if (!(this->noise > 0) || !std::isfinite(this->noise))
  {
    throw Error("The relative noise of the features' depth must be positive.");
  }
  if (!(this->grazingAngle >= 0 && this->grazingAngle < 90))
  {
    throw Error("The grazing angle of bridges must be in [0, 90) degrees.");
  }
  if (this->views < 1)
  {
    throw Error("At least one view must see through a bridge to refute it.");
  }
  if (!(this->edgeWidth >= 0))
  {
    throw Error("The width of edges must not be negative.");
  }
  this->partners.Check();
}

void ContinueBackground(std::vector<DisparityMap>& maps, const FeatureCloud& cloud,
  const BackgroundOptions& options, const ParallelFor& parallelFor, const Progress& progress)
{
  options.Check();
  std::vector<double> work;
  std::transform(maps.begin(), maps.end(), std::back_inserter(work),
    [](const DisparityMap& map) { return static_cast<double>(map.triangles.size()); });
  std::vector<std::unique_ptr<BridgedMap>> bridged(maps.size());
  ParallelForWithProgress(work, parallelFor, progress.Part(0.0, 0.4),
    [&](std::size_t v, const CancellationFlag& stop)
    { bridged[v] = std::make_unique<BridgedMap>(maps[v], options, stop); });
  const std::vector<std::vector<int>> overlapping = OverlappingViews(maps);
  const std::vector<std::vector<int>> partners = PartnerViews(maps, options.partners);
  maps = MakeAll<DisparityMap>(work, parallelFor, progress.Part(0.4, 1.0),
    [&](std::size_t v, const CancellationFlag& stop)
    {
      std::vector<int> compared;
      std::set_intersection(overlapping[v].begin(), overlapping[v].end(), partners[v].begin(),
        partners[v].end(), std::back_inserter(compared));
      BackgroundContinuer::Others others;
      std::transform(compared.begin(), compared.end(), std::back_inserter(others),
        [&](int other) { return bridged[static_cast<std::size_t>(other)].get(); });
      std::vector<int> withOwn = partners[v];
      withOwn.insert(
        std::lower_bound(withOwn.begin(), withOwn.end(), static_cast<int>(v)), static_cast<int>(v));
      return BackgroundContinuer(*bridged[v], std::move(others), options)
        .Continue(cloud, withOwn, stop);
    });
}

void ContinueBackground(std::vector<DisparityMap>& maps, const std::vector<View>& views,
  const BackgroundOptions& options, const ParallelFor& parallelFor, const Progress& progress)
{
  ContinueBackground(maps, FeatureCloud(views), options, parallelFor, progress);
}

}
