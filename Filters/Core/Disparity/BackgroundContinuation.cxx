// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/BackgroundContinuation.h"

#include "Common/Error.h"
#include "Common/ParallelForWithProgress.h"
#include "Disparity/OverlappingViews.h"
#include "ViewFreespace/ViewFreespace.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <unordered_map>

namespace freespace
{

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

// In units of the noise: what is more is a jump, seen through, not a plane, sticks out.
constexpr double LeastJump = 10;
constexpr double SeeThrough = 4;
constexpr double Flatness = 2;
constexpr double SticksOut = 2;

// Where a bridge is asked for, from its far side (0) to a near corner (1).
constexpr double NearSide = 0.8;

// A map with what is asked of it again and again.
struct Scene
{
  Scene(const DisparityMap& map, const BackgroundContinuationOptions& options, const CancellationFlag& stop);

  bool Spans(std::size_t triangle, const BackgroundContinuationOptions& options) const;

  const DisparityMap& map;
  ViewFreespace freespace;
  std::vector<double> disparity;      // per point
  std::vector<char> isBridge;         // per triangle
  std::vector<int> soundBegin, sound; // around each point, the triangles that are no bridges
};

Scene::Scene(
  const DisparityMap& given, const BackgroundContinuationOptions& options, const CancellationFlag& stop)
  : map(given)
  , freespace(given, stop)
  , isBridge(given.triangles.size())
  , soundBegin(given.points.size() + 2, 0)
{
  this->disparity.reserve(given.points.size());
  for (const Vector3d& point : given.points)
  {
    this->disparity.push_back(1 / given.camera.Depth(point));
  }
  for (std::size_t t = 0; t < given.triangles.size(); ++t)
  {
    ThrowIfCancelled(stop);
    this->isBridge[t] = this->Spans(t, options);
    for (int corner : given.triangles[t])
    {
      this->soundBegin[corner + 2] += this->isBridge[t] ? 0 : 1;
    }
  }
  std::partial_sum(this->soundBegin.begin(), this->soundBegin.end(), this->soundBegin.begin());
  this->sound.resize(this->soundBegin.back());
  for (std::size_t t = 0; t < given.triangles.size(); ++t)
  {
    for (int corner : given.triangles[t])
    {
      if (!this->isBridge[t])
      {
        this->sound[this->soundBegin[corner + 1]++] = static_cast<int>(t);
      }
    }
  }
}

// Whether a triangle spans a jump: far deeper than noise, and seen almost from its edge.
bool Scene::Spans(std::size_t triangle, const BackgroundContinuationOptions& options) const
{
  const auto [a, b, c] = this->map.triangles[triangle];
  const auto [far, near] =
    std::minmax({ this->disparity[a], this->disparity[b], this->disparity[c] });
  const Vector3d& p = this->map.points[a];
  const Vector3d& q = this->map.points[b];
  const Vector3d& r = this->map.points[c];
  const Vector3d normal = (q - p).cross(r - p);
  const Vector3d sight = (p + q + r) / 3 - this->map.camera.Center();
  return near > far * (1 + LeastJump * options.noise) &&
    std::abs(normal.dot(sight)) <
    std::cos(options.grazingAngle * M_PI / 180) * normal.norm() * sight.norm();
}

// The parts of the image that bridges touch. Most points are far from any bridge, and this tells so at
// the cost of a projection.
class BridgeMask
{
public:
  explicit BridgeMask(const Scene& scene);

  bool MayHold(const Vector2d& pixel) const
  {
    return this->Box.contains(pixel) && this->Touched[Index(this->Block(pixel))];
  }

private:
  static constexpr int Blocks = 512; // along each side

  Eigen::Array2i Block(const Vector2d& pixel) const
  {
    return ((pixel - this->Box.min()).array() * this->BlocksPerPixel).cast<int>().min(Blocks - 1);
  }
  static int Index(const Eigen::Array2i& block) { return block.y() * Blocks + block.x(); }

  Eigen::AlignedBox2d Box;
  Eigen::Array2d BlocksPerPixel;
  std::vector<char> Touched;
};

BridgeMask::BridgeMask(const Scene& scene)
  : Touched(Blocks * Blocks, 0)
{
  const DisparityMap& map = scene.map;
  for (const auto& triangle : map.triangles)
  {
    for (int corner : triangle)
    {
      this->Box.extend(map.imagePoints[corner]);
    }
  }
  this->BlocksPerPixel = Blocks / this->Box.sizes().array().max(1e-9);
  for (std::size_t t = 0; t < map.triangles.size(); ++t)
  {
    if (scene.isBridge[t])
    {
      const auto [a, b, c] = map.triangles[t];
      Eigen::AlignedBox2d box(map.imagePoints[a]);
      box.extend(map.imagePoints[b]).extend(map.imagePoints[c]);
      const Eigen::Array2i first = this->Block(box.min()), last = this->Block(box.max());
      for (int y = first.y(); y <= last.y(); ++y)
      {
        std::fill(
          &this->Touched[Index({ first.x(), y })], &this->Touched[Index({ last.x(), y })] + 1, 1);
      }
    }
  }
}

// Works on one view, with all others around it.
class BackgroundContinuer
{
public:
  /// The scenes of the other views that see a part of what this one sees.
  using Others = std::vector<const Scene*>;

  BackgroundContinuer(const Scene& own, Others others, const BackgroundContinuationOptions& options)
    : Own(own)
    , OtherScenes(std::move(others))
    , Options(options)
    , Stamp(this->Own.map.points.size(), -1)
  {
  }

  DisparityMap Continue(const FeatureCloud& cloud, const CancellationFlag& stop);

private:
  struct SetBackBridge
  {
    std::size_t triangle;
    std::array<double, 3> disparity; // at its corners, once it is set back
  };

  std::vector<SetBackBridge> RefutedBridges(const CancellationFlag& stop);
  std::vector<std::vector<Vector3d>> PointsInBridges(
    const FeatureCloud& cloud, const CancellationFlag& stop) const;
  double MiddleOfJump(std::size_t triangle) const;
  bool IsRefuted(std::size_t triangle) const;
  bool IsSeenThrough(const Vector3d& place) const;
  std::optional<double> SetBack(std::size_t triangle, int near);
  std::optional<double> PlaneAround(int far, int near);
  std::optional<double> FitPlane(int far, const Vector2d& pixel);
  std::vector<int> FarPointsAround(int far, double radius);
  double SurfaceBehind(const Vector2d& pixel, double from, double to) const;
  std::optional<double> Crossing(
    const Scene& other, const Vector2d& pixel, double from, double to) const;
  bool IsViolated(std::size_t triangle, const std::array<double, 3>& disparity,
    const std::vector<Vector3d>& points) const;
  double DistanceToNearSide(std::size_t triangle, const Vector2d& pixel) const;

  const Scene& Own;
  Others OtherScenes;
  const BackgroundContinuationOptions& Options;
  std::unordered_map<std::uint64_t, std::optional<double>> Planes; // by their edge's ends
  std::vector<int> Stamp; // of the last search that came by a point
  int Search = 0;
};

double BackgroundContinuer::MiddleOfJump(std::size_t triangle) const
{
  const auto [a, b, c] = this->Own.map.triangles[triangle];
  const auto [far, near] =
    std::minmax({ this->Own.disparity[a], this->Own.disparity[b], this->Own.disparity[c] });
  return (far + near) / 2;
}

// Whether other views see through the bridge close to each of its near corners. Where they see
// through it further off only, the edge that hides the background was missed: it lies somewhere
// within the bridge, and between it and the near corners there is matter.
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
  for (const Scene* other : this->OtherScenes)
  {
    const ViewFreespace::Sample sample = other->freespace.At(place);
    const double depth = other->map.camera.Depth(place);
    views += sample.triangle >= 0 && sample.value > SeeThrough * this->Options.noise * depth;
  }
  return views >= this->Options.views;
}

// Points around a far one, over triangles that are no bridges.
std::vector<int> BackgroundContinuer::FarPointsAround(int far, double radius)
{
  constexpr std::size_t enough = 200;
  const DisparityMap& map = this->Own.map;
  std::vector<int> found = { far };
  this->Stamp[far] = ++this->Search;
  for (std::size_t i = 0; i < found.size() && found.size() < enough; ++i)
  {
    for (int s = this->Own.soundBegin[found[i]]; s < this->Own.soundBegin[found[i] + 1]; ++s)
    {
      for (int corner : map.triangles[this->Own.sound[s]])
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

// The disparity at a pixel of the plane through the points around a far one, as widely as the pixel
// is away; none where they do not lie in a plane.
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

// The same at a near point's pixel. The two bridges beside an edge both ask for it.
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

// Where a ray of this view goes into the surface of another one, coming through its free space;
// between two disparities. Only a surface counts: neither a bridge nor the edge of the map.
std::optional<double> BackgroundContinuer::Crossing(
  const Scene& other, const Vector2d& pixel, double from, double to) const
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

// The first of the other views' surfaces behind the jump's middle; 0 where there is none.
double BackgroundContinuer::SurfaceBehind(const Vector2d& pixel, double from, double to) const
{
  std::optional<double> nearest;
  for (const Scene* other : this->OtherScenes)
  {
    // Only what is nearer than all before can matter.
    const auto crossing = this->Crossing(*other, pixel, from, nearest.value_or(to));
    nearest = crossing ? crossing : nearest;
  }
  return nearest.value_or(0);
}

// The background's disparity at a near corner of a bridge; none where it is not known.
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
        sum += std::max(*plane, disparity); // never deeper than what is seen
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

// Whether a known point would stick out of the triangle with new disparities at its corners.
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

// The bridges that are refuted and below which the background is known.
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

// All views' points that project into bridges, by triangle.
std::vector<std::vector<Vector3d>> BackgroundContinuer::PointsInBridges(
  const FeatureCloud& cloud, const CancellationFlag& stop) const
{
  std::vector<std::vector<Vector3d>> points(this->Own.map.triangles.size());
  const BridgeMask mask(this->Own);
  cloud.VisitSeen(this->Own.map.camera,
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

DisparityMap BackgroundContinuer::Continue(const FeatureCloud& cloud, const CancellationFlag& stop)
{
  DisparityMap map = this->Own.map;
  std::vector<double> disparity = this->Own.disparity;
  std::vector<std::vector<int>> setBack(map.points.size()); // behind each point
  const std::vector<std::vector<Vector3d>> points = this->PointsInBridges(cloud, stop);
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
      // Bridges side by side share the corner where they agree on it.
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

void BackgroundContinuationOptions::Check() const
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
}

void ContinueBackground(std::vector<DisparityMap>& maps, const FeatureCloud& cloud,
  const BackgroundContinuationOptions& options, const ParallelFor& parallelFor,
  const Progress& progress)
{
  options.Check();
  std::vector<double> work;
  std::transform(maps.begin(), maps.end(), std::back_inserter(work),
    [](const DisparityMap& map) { return static_cast<double>(map.triangles.size()); });
  std::vector<std::unique_ptr<Scene>> scenes(maps.size());
  ParallelForWithProgress(work, parallelFor, progress.Part(0.0, 0.4),
    [&](std::size_t v, const CancellationFlag& stop)
    { scenes[v] = std::make_unique<Scene>(maps[v], options, stop); });
  const std::vector<std::vector<int>> overlapping = OverlappingViews(maps);
  std::vector<DisparityMap> continued(maps.size());
  ParallelForWithProgress(work, parallelFor, progress.Part(0.4, 1.0),
    [&](std::size_t v, const CancellationFlag& stop)
    {
      BackgroundContinuer::Others others;
      for (int other : overlapping[v])
      {
        others.push_back(scenes[other].get());
      }
      continued[v] =
        BackgroundContinuer(*scenes[v], std::move(others), options).Continue(cloud, stop);
    });
  maps = std::move(continued);
}

void ContinueBackground(std::vector<DisparityMap>& maps, const std::vector<View>& views,
  const BackgroundContinuationOptions& options, const ParallelFor& parallelFor,
  const Progress& progress)
{
  ContinueBackground(maps, FeatureCloud(views), options, parallelFor, progress);
}

}
