// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/FreespaceUnion.h"

#include "Common/Error.h"
#include "Common/ParallelForWithProgress.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <tuple>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

/// As many as the labels of a surface can tell apart.
constexpr std::size_t MostViews = 8191;

/// So many views are asked for a point faster than they are found by an index.
constexpr std::size_t FewViews = 12;

/// From here on the matter is lost in the box around the hull: somebody took it for a length.
constexpr double MostMargin = 10.0;

void CheckTriangles(const DisparityMap& map)
{
  const int n = static_cast<int>(map.points.size());
  for (const auto& triangle : map.triangles)
  {
    for (int corner : triangle)
    {
      if (corner < 0 || corner >= n)
      {
        throw Error("The map " + map.name + " has a triangle that names point " +
          std::to_string(corner) + " of " + std::to_string(n) + ".");
      }
    }
  }
}

// What spans the hull: not what was put behind an occluding edge.
std::vector<Vector3d> FiniteFeatures(const DisparityMap& map)
{
  std::vector<Vector3d> features;
  for (std::size_t i = 0; i < map.points.size(); ++i)
  {
    const bool isFeature = i >= map.sourceView.size() || map.sourceView[i] >= 0;
    if (isFeature && map.points[i].allFinite())
    {
      features.push_back(map.points[i]);
    }
  }
  return features;
}

}

void FreespaceUnionOptions::Check() const
{
  if (this->minimumViews < 1)
  {
    throw Error("The minimum number of views is " + std::to_string(this->minimumViews) +
      ", it must be at least 1.");
  }
  if (!(this->hullMargin >= 0 && this->hullMargin < MostMargin))
  {
    std::ostringstream sentence;
    sentence << "The margin of the hull is " << this->hullMargin
             << ", it must be 0 or greater and less than " << MostMargin
             << ": it is a fraction of the diagonal of the features' box.";
    throw Error(sentence.str());
  }
}

FreespaceUnion::FreespaceUnion(const std::vector<DisparityMap>& maps,
  const FreespaceUnionOptions& options, const ParallelFor& parallelFor, const Progress& progress)
  : FreespaceUnion(
      maps.size(), [&maps](std::size_t i) { return maps[i]; }, options, parallelFor, progress)
{
}

FreespaceUnion::FreespaceUnion(std::size_t count, const MapSource& mapOf,
  const FreespaceUnionOptions& options, const ParallelFor& parallelFor, const Progress& progress)
  : Options(options)
  , Views(count)
{
  options.Check();
  this->CheckCount();
  std::vector<std::vector<Vector3d>> outer(count);
  std::vector<Eigen::AlignedBox3d> boxes(count);
  std::mutex asking;
  ParallelForWithProgress(count, parallelFor, progress.Part(0.0, 0.9),
    [&](std::size_t i, const CancellationFlag& stop)
    {
      const DisparityMap map = [&]
      {
        const std::lock_guard<std::mutex> lock(asking);
        ThrowIfCancelled(stop);
        return mapOf(i);
      }();
      CheckTriangles(map);
      const std::vector<Vector3d> features = FiniteFeatures(map);
      for (const Vector3d& feature : features)
      {
        boxes[i].extend(feature);
      }
      outer[i] = FeatureHull::OuterPoints(features, stop);
      this->Views[i] = std::make_unique<ViewFreespace>(map, stop);
    });
  std::vector<Vector3d> features;
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < count; ++i)
  {
    features.insert(features.end(), outer[i].begin(), outer[i].end());
    box.extend(boxes[i]);
  }
  const double margin = features.empty() ? 0.0 : options.hullMargin * box.diagonal().norm();
  RunWithProgress(progress.Part(0.9, 1.0),
    [&](const CancellationFlag& stop)
    { this->FeaturesHull = std::make_unique<FeatureHull>(features, margin, stop); });
}

void FreespaceUnion::CheckCount() const
{
  const std::size_t count = this->Views.size();
  const int minimum = this->Options.minimumViews;
  if (count > MostViews)
  {
    throw Error("There are " + std::to_string(count) + " views, at most " +
      std::to_string(MostViews) + " can be united.");
  }
  // Nothing but the hull could ever be free. Without any views all is free anyway.
  if (count > 0 && static_cast<std::size_t>(minimum) > count)
  {
    throw Error("The minimum number of views is " + std::to_string(minimum) +
      ", but there are only " + std::to_string(count) + " views.");
  }
}

FreespaceUnion::Winner FreespaceUnion::Evaluate(const Vector3d& point) const
{
  const int plane = this->Hull().NearestPlane(point);
  if (plane < 0)
  {
    return { HUGE_VAL, Vector3d::Zero() };
  }
  const Winner hull = { this->Hull().Distance(plane, point), this->Hull().Normal(plane) };
  std::vector<Winner> claims;
  const auto ask = [&](const ViewFreespace& view)
  {
    const ViewFreespace::Sample sample = view.At(point);
    if (sample.triangle >= 0)
    {
      claims.push_back({ sample.value, sample.gradient });
    }
  };
  if (this->ClaimIndex().Contains(point))
  {
    const ViewOctree::Part part = this->ClaimIndex().At(point);
    std::for_each(part.begin, part.end, [&](int view) { ask(*this->Views[view]); });
  }
  else
  {
    std::for_each(this->Views.begin(), this->Views.end(), [&](const auto& view) { ask(*view); });
  }
  const std::size_t k = static_cast<std::size_t>(this->Options.minimumViews);
  if (claims.size() < k)
  {
    return hull;
  }
  std::nth_element(claims.begin(), claims.begin() + (k - 1), claims.end(),
    [](const Winner& a, const Winner& b) { return a.value > b.value; });
  return claims[k - 1].value > hull.value ? claims[k - 1] : hull;
}

double FreespaceUnion::Value(const Vector3d& point) const
{
  return this->Evaluate(point).value;
}

Vector3d FreespaceUnion::Gradient(const Vector3d& point) const
{
  return this->Evaluate(point).gradient;
}

FieldScope FreespaceUnion::Root() const
{
  FieldScope scope;
  scope.views.resize(this->Views.size());
  std::iota(scope.views.begin(), scope.views.end(), 0);
  scope.planes.resize(this->Hull().NumberOfPlanes());
  std::iota(scope.planes.begin(), scope.planes.end(), 0);
  return scope;
}

// Deep, because a part that a view has decided costs nothing more to ask.
const ViewOctree& FreespaceUnion::FreeIndex(const Progress& progress) const
{
  static constexpr int deepestLevel = 7;
  std::call_once(this->FreeIsIndexed,
    [&]
    {
      this->Free = std::make_unique<ViewOctree>(
        this->Views, this->Hull().Bounds(),
        [](const ViewFreespace& view, const Eigen::AlignedBox3d& box)
        { return view.Classify(box); },
        this->Options.minimumViews, deepestLevel, progress);
    });
  return *this->Free;
}

void FreespaceUnion::IndexForBoxes(const Progress& progress) const
{
  progress(0.0);
  if (!this->Hull().IsEmpty())
  {
    this->FreeIndex(progress);
  }
  progress(1.0);
}

void FreespaceUnion::IndexForPoints(const Progress& progress) const
{
  if (this->Views.size() > FewViews)
  {
    this->IndexForBoxes(progress);
  }
}

// Shallow: the cones that views look into are wide.
const ViewOctree& FreespaceUnion::ClaimIndex() const
{
  static constexpr int deepestLevel = 4;
  std::call_once(this->ClaimsAreIndexed,
    [this]
    {
      this->Claims = std::make_unique<ViewOctree>(
        this->Views, this->Hull().Bounds(),
        [](const ViewFreespace& view, const Eigen::AlignedBox3d& box)
        { return view.MayClaim(box) ? BoxContent::Mixed : BoxContent::Matter; },
        this->Options.minimumViews, deepestLevel);
    });
  return *this->Claims;
}

FieldScope FreespaceUnion::ScopeAround(const Eigen::AlignedBox3d& box) const
{
  FieldScope scope = this->Root();
  if (!this->Hull().IsEmpty() && this->FreeIndex().Contains(box))
  {
    const ViewOctree::Part part = this->FreeIndex().Around(box);
    scope.views.assign(part.begin, part.end);
    scope.freeViews = part.freeViews;
  }
  return scope;
}

bool FreespaceUnion::IsSeenFree(const Vector3d& point) const
{
  const int enough = this->Options.minimumViews;
  int free = 0;
  const auto tells = [&](const ViewFreespace& view)
  { return view.IsFree(point) && ++free >= enough; };
  if (this->Views.size() <= FewViews || !this->Hull().Bounds().contains(point))
  {
    return std::any_of(
      this->Views.begin(), this->Views.end(), [&](const auto& view) { return tells(*view); });
  }
  const ViewOctree::Part part = this->FreeIndex().At(point);
  free = part.freeViews;
  return free >= enough ||
    std::any_of(part.begin, part.end, [&](int view) { return tells(*this->Views[view]); });
}

bool FreespaceUnion::IsFree(const Vector3d& point) const
{
  if (!this->Hull().Bounds().contains(point) || this->IsSeenFree(point))
  {
    return true;
  }
  const int plane = this->Hull().NearestPlane(point);
  return plane < 0 || this->Hull().Distance(plane, point) > 0;
}

bool FreespaceUnion::IsFree(const Vector3d& point, const FieldScope& scope) const
{
  if (this->Hull().IsEmpty() || scope.freeViews >= this->Options.minimumViews)
  {
    return true;
  }
  int free = scope.freeViews;
  int left = static_cast<int>(scope.views.size());
  for (int view : scope.views)
  {
    if (free + left < this->Options.minimumViews)
    {
      break;
    }
    --left;
    if (this->Views[view]->IsFree(point) && ++free >= this->Options.minimumViews)
    {
      return true;
    }
  }
  return std::any_of(scope.planes.begin(), scope.planes.end(),
    [&](int plane) { return this->Hull().Distance(plane, point) > 0; });
}

BoxContent FreespaceUnion::Classify(
  const Eigen::AlignedBox3d& box, const FieldScope& parent, FieldScope& scope) const
{
  if (this->Hull().IsEmpty() || parent.freeViews >= this->Options.minimumViews)
  {
    return BoxContent::Free;
  }
  const BoxContent hull = this->Hull().Classify(box, parent.planes, scope.planes);
  scope.views.clear();
  scope.freeViews = parent.freeViews;
  if (hull == BoxContent::Free)
  {
    return BoxContent::Free;
  }
  for (int view : parent.views)
  {
    const BoxContent content = this->Views[view]->Classify(box);
    if (content == BoxContent::Mixed)
    {
      scope.views.push_back(view);
    }
    else if (content == BoxContent::Free && ++scope.freeViews >= this->Options.minimumViews)
    {
      return BoxContent::Free;
    }
  }
  return this->CanOpen(scope) ? BoxContent::Mixed : BoxContent::Matter;
}

// Whether anything that a scope leaves open can still make a point free.
bool FreespaceUnion::CanOpen(const FieldScope& scope) const
{
  return !scope.planes.empty() ||
    scope.freeViews + static_cast<int>(scope.views.size()) >= this->Options.minimumViews;
}

BoxContent FreespaceUnion::ClassifyFinely(const Eigen::AlignedBox3d& box, FieldScope& scope) const
{
  std::vector<int> open;
  for (int view : scope.views)
  {
    const BoxContent content = this->Views[view]->ClassifyFinely(box);
    if (content == BoxContent::Mixed)
    {
      open.push_back(view);
    }
    else if (content == BoxContent::Free && ++scope.freeViews >= this->Options.minimumViews)
    {
      return BoxContent::Free;
    }
  }
  scope.views = std::move(open);
  return this->CanOpen(scope) ? BoxContent::Mixed : BoxContent::Matter;
}

bool FreespaceUnion::Crossing(const Vector3d& matter, const Vector3d& free, const FieldScope& scope,
  double& place, SurfaceLabel& label) const
{
  place = 2.0;
  for (int plane : scope.planes)
  {
    const double inside = this->Hull().Distance(plane, matter);
    const double outside = this->Hull().Distance(plane, free);
    if (outside > 0 && inside / (inside - outside) < place)
    {
      place = inside / (inside - outside);
      label = { -1, SurfaceKind::Hull, this->Hull().Normal(plane) };
    }
  }
  const int opener = this->FirstAgreement(matter, free, scope, place);
  if (opener >= 0)
  {
    label = this->LabelOfView(opener, matter + place * (free - matter), free - matter);
  }
  return place >= 0 && place <= 1;
}

// Where, before a place on a segment, enough views agree for the first time that it is free; and the
// view that is the last to agree. -1: nowhere.
int FreespaceUnion::FirstAgreement(
  const Vector3d& matter, const Vector3d& free, const FieldScope& scope, double& place) const
{
  // A view begins (1) or ends (-1) to be free. Where one ends and another begins they do not agree.
  struct Change
  {
    double place;
    int step, view;
    bool operator<(const Change& other) const
    {
      return std::tie(place, step, view) < std::tie(other.place, other.step, other.view);
    }
  };
  thread_local ViewFreespace::Intervals intervals;
  thread_local std::vector<Change> changes;
  changes.clear();
  int opener = -1;
  for (int view : scope.views)
  {
    this->Views[view]->FreeIntervals(matter, free, intervals);
    if (this->Options.minimumViews == 1)
    {
      if (!intervals.empty() && intervals.front().first < place)
      {
        place = intervals.front().first;
        opener = view;
      }
      continue;
    }
    for (const auto& [begin, end] : intervals)
    {
      if (begin >= place)
      {
        break;
      }
      changes.push_back({ begin, 1, view });
      changes.push_back({ end, -1, view });
    }
  }
  std::sort(changes.begin(), changes.end());
  int agreeing = scope.freeViews;
  for (const Change& change : changes)
  {
    agreeing += change.step;
    if (change.step > 0 && agreeing >= this->Options.minimumViews && change.place < place)
    {
      place = change.place;
      return change.view;
    }
  }
  return opener;
}

// What the surface is where a view begins to be free, on the way from matter.
SurfaceLabel FreespaceUnion::LabelOfView(
  int view, const Vector3d& crossing, const Vector3d& towardsFree) const
{
  const ViewFreespace& opener = *this->Views[view];
  const double step = 1e-6;
  const ViewFreespace::Sample sample = opener.At(crossing);
  // On the map the value is nothing but rounding; over a wall it is the height above the map.
  if (sample.triangle >= 0 &&
    std::abs(sample.value) <= step * sample.gradient.norm() * towardsFree.norm())
  {
    const bool isJump = opener.IsEdgeOn(crossing, sample.gradient);
    return { view, isJump ? SurfaceKind::Wall : SurfaceKind::Feature,
      sample.gradient.normalized() };
  }
  const Vector3d normal =
    opener.WallNormal(crossing + step * towardsFree, crossing - step * towardsFree);
  return { view, SurfaceKind::Wall, normal };
}

SurfaceLabel FreespaceUnion::Label(
  const Vector3d& free, const Vector3d& matter, const FieldScope& scope) const
{
  SurfaceLabel label;
  double greatest = 0.0;
  for (int plane : scope.planes)
  {
    const double outside = this->Hull().Distance(plane, free);
    if (outside > greatest)
    {
      greatest = outside;
      label.normal = this->Hull().Normal(plane);
    }
  }
  // The view that opened the way: free on one side, not on the other, by as much as possible.
  for (int view : scope.views)
  {
    const ViewFreespace::Sample front = this->Views[view]->At(free);
    if (front.triangle < 0 || !(front.value > greatest))
    {
      continue;
    }
    const ViewFreespace::Sample behind = this->Views[view]->At(matter);
    if (behind.triangle >= 0 && behind.value > 0)
    {
      continue;
    }
    greatest = front.value;
    label.view = view;
    const bool isBorder = behind.triangle < 0;
    const bool isJump = this->Views[view]->IsEdgeOn(free, front.gradient);
    label.kind = isBorder || isJump ? SurfaceKind::Wall : SurfaceKind::Feature;
    label.normal =
      isBorder ? this->Views[view]->WallNormal(free, matter) : front.gradient.normalized();
  }
  return label;
}

}
