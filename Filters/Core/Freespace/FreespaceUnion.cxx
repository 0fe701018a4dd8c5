// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/FreespaceUnion.h"

#include "Common/Error.h"
#include "Common/ParallelForWithProgress.h"
#include "Freespace/CameraSurroundings.h"
#include "Freespace/ViewAgreement.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

/// The number of views that labels of a surface can represent.
constexpr std::size_t MostViews = 8191;

/// Up to this number of views, evaluating all is faster than a query of the octree.
constexpr std::size_t FewViews = 12;

/// A greater margin is no fraction but a length by mistake: the surface would be lost in the hull's
/// box.
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

}

void FreespaceUnionOptions::Check() const
{
  if (this->minimumViews < 1 && this->minimumViews != AutomaticViews)
  {
    throw Error("The minimum number of views is " + std::to_string(this->minimumViews) +
      ", it must be at least 1.");
  }
  this->region.Check();
  this->resolution.Check();
  if (!(this->surroundings >= 0 && this->surroundings < 1))
  {
    throw Error("The surroundings of the cameras must be 0 or greater and less than 1.");
  }
  if (!(this->hullMarginCells >= 0))
  {
    throw Error("The margin of the hull in cells must be 0 or greater.");
  }
  if (this->hullMargin != AutomaticMargin &&
    !(this->hullMargin >= 0 && this->hullMargin < MostMargin))
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
  , NumberOfMaps(count)
  , Views(count)
{
  options.Check();
  this->CheckCount();
  std::vector<ViewFeatures> features(count);
  std::mutex asking;
  ParallelForWithProgress(count, parallelFor, progress.Part(0.0, 0.8),
    [&](std::size_t i, const CancellationFlag& stop)
    {
      const DisparityMap map = [&]
      {
        const std::lock_guard<std::mutex> lock(asking);
        ThrowIfCancelled(stop);
        return mapOf(i);
      }();
      CheckTriangles(map);
      features[i] = FeaturesOfMap(map, i);
      this->Views[i] = std::make_unique<ViewFreespace>(map, stop);
    });
  const bool isAutomatic = options.hullMargin == FreespaceUnionOptions::AutomaticMargin;
  this->Region = MakeRegionHull(features, options.region, options.resolution,
    isAutomatic ? -options.hullMarginCells : options.hullMargin, parallelFor,
    progress.Part(0.8, 0.9));
  this->ChooseMinimumViews(features, parallelFor, progress.Part(0.9, 1.0));
  this->AddSurroundings(features);
  progress(1.0);
}

void FreespaceUnion::ChooseMinimumViews(const std::vector<ViewFeatures>& features,
  const ParallelFor& parallelFor, const Progress& progress)
{
  constexpr double spacings = 2.4; // some cells of the lattice
  if (this->Options.minimumViews == FreespaceUnionOptions::AutomaticViews)
  {
    const int most = std::min(2, std::max(1, static_cast<int>(this->NumberOfMaps)));
    this->Options.minimumViews = ViewsThatMustAgree(ErrorsOfAgreement(
      this->Views, features, this->Region.region.box, spacings, most, parallelFor, progress));
  }
}

// As often as makes them free by themselves.
void FreespaceUnion::AddSurroundings(const std::vector<ViewFeatures>& features)
{
  for (const DisparityMap& map :
    CameraSurroundings(features, this->Region, this->Options.surroundings))
  {
    for (int i = 0; i < this->Options.minimumViews; ++i)
    {
      this->Views.push_back(std::make_unique<ViewFreespace>(map));
      this->SurroundedView.push_back(map.sourceView.front());
    }
  }
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
  // No point inside the hull could be free. Without any views everything is free anyway.
  if (count > 0 && minimum > static_cast<int>(count))
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

// Deep, because a node that is decided costs nothing more to query.
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

// Shallow: the viewing cones are wide.
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

// Whether the undecided views and planes of a scope can still make a point free.
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

}
