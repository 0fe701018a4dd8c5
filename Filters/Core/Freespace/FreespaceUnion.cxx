// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/FreespaceUnion.h"

#include "Common/Error.h"
#include "Freespace/CameraSurroundings.h"

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

VoteRule RuleOf(const FreespaceUnionOptions& options, std::size_t views)
{
  constexpr int enough = 3;
  if (options.minimumViews != FreespaceUnionOptions::AutomaticViews)
  {
    return { options.minimumViews, false };
  }
  // One map is contradicted by nobody.
  return { std::max(1, static_cast<int>(std::min<std::size_t>(views, enough))), views > 1 };
}

}

double FreespaceUnionOptions::MarginFor(double cells, double distances) const
{
  const double enough = std::max<double>(distances, this->hullMarginFewest);
  return this->hullMargin != AutomaticMargin ? this->hullMargin
                                             : this->hullMarginCells / std::min(cells, enough);
}

double FreespaceUnionOptions::MarginOfLattice(int cells)
{
  const FreespaceUnionOptions defaults;
  const bool isCoarse = cells > 0 && cells < defaults.resolution.fewestCells;
  return isCoarse ? defaults.MarginFor(cells, cells) : AutomaticMargin;
}

void FreespaceUnionOptions::Check() const
{
  if (this->minimumViews < 1 && this->minimumViews != AutomaticViews)
  {
    throw Error("The minimum number of views is " + std::to_string(this->minimumViews) +
      ", it must be at least 1.");
  }
  if (!(this->contradiction > 0 && std::isfinite(this->contradiction)))
  {
    throw Error("The depth within which a view contradicts others must be positive.");
  }
  this->region.Check();
  this->resolution.Check();
  if (!(this->surroundings >= 0 && this->surroundings < 1))
  {
    throw Error("The surroundings of the cameras must be 0 or greater and less than 1.");
  }
  if (!(this->hullMarginCells >= 0 && this->hullMarginFewest >= 1))
  {
    throw Error("The margin of the hull in cells must be 0 or greater, of one distance or more.");
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

void FreespaceUnionOptions::CheckFor(std::size_t views) const
{
  this->Check();
  if (views > MostViews)
  {
    throw Error("There are " + std::to_string(views) + " views, at most " +
      std::to_string(MostViews) + " can be united.");
  }
  // No point inside the hull could be free. Without any views everything is free anyway.
  if (views > 0 && this->minimumViews > static_cast<int>(views))
  {
    throw Error("The minimum number of views is " + std::to_string(this->minimumViews) +
      ", but there are only " + std::to_string(views) + " views.");
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
  : FreespaceUnion((options.CheckFor(count),
                     CompleteMaps(SharedMaps(count), mapOf, parallelFor, progress.Part(0.0, 0.8))),
      options, parallelFor, progress.Part(0.8, 1.0))
{
}

FreespaceUnion::FreespaceUnion(const SharedMaps& maps, const FreespaceUnionOptions& options,
  const ParallelFor& parallelFor, const Progress& progress)
  : Options(options)
  , Maps(maps)
{
  options.CheckFor(maps.size());
  this->Votes = RuleOf(options, maps.size());
  std::vector<ViewFeatures> features;
  for (const std::shared_ptr<const MapFreespace>& map : maps)
  {
    features.push_back(map->features);
    this->Views.emplace_back(map, &map->freespace);
  }
  this->Region = MakeRegionHull(
    features, options.region, options.resolution,
    [&options](double cells, double distances) { return options.MarginFor(cells, distances); },
    parallelFor, progress);
  this->AddSilhouettes(features);
  this->AddSurroundings(features);
  this->FindMargins(features);
  this->AllViews.resize(this->Views.size());
  std::iota(this->AllViews.begin(), this->AllViews.end(), 0);
  progress(1.0);
}

// The maps' views contradict where more than some views must agree, the surroundings of cameras nothing.
void FreespaceUnion::FindMargins(const std::vector<ViewFeatures>& features)
{
  this->Margins.assign(this->Views.size(), 0);
  for (std::size_t i = 0; this->Votes.isMajority && i < features.size(); ++i)
  {
    if (features[i].HasNone())
    {
      continue; // a silhouette
    }
    const double margin = this->Options.contradiction * std::max(features[i].spacing, 1.0) /
      features[i].camera.FocalLength();
    this->Margins[i] = std::isfinite(margin) ? margin : 0;
  }
}

// A map without features is a silhouette, which is certain: it is there as often as makes it free by itself.
void FreespaceUnion::AddSilhouettes(const std::vector<ViewFeatures>& features)
{
  for (std::size_t v = 0; v < features.size(); ++v)
  {
    for (int i = 1; features[v].HasNone() && i < this->Votes.enough; ++i)
    {
      this->Views.push_back(this->Views[v]);
      this->AddedView.push_back(static_cast<int>(v));
      this->AddedCorners.emplace_back();
    }
  }
}

// As often as makes them free by themselves.
void FreespaceUnion::AddSurroundings(const std::vector<ViewFeatures>& features)
{
  for (const DisparityMap& map :
    CameraSurroundings(features, this->Region, this->Options.surroundings))
  {
    const auto freespace = std::make_shared<const ViewFreespace>(map);
    for (int i = 0; i < this->Votes.enough; ++i)
    {
      this->Views.push_back(freespace);
      this->AddedView.push_back(map.sourceView.front());
      this->AddedCorners.push_back(map.points);
    }
  }
}

bool FreespaceUnion::HasSameView(int view, const FreespaceUnion& other, int otherView) const
{
  const auto cornersOf = [](const FreespaceUnion& phi, int index)
  {
    const std::size_t i = static_cast<std::size_t>(index), maps = phi.Maps.size();
    return i < maps ? std::vector<Vector3d>() : phi.AddedCorners[i - maps];
  };
  const auto &own = this->Views[static_cast<std::size_t>(view)],
             &its = other.Views[static_cast<std::size_t>(otherView)];
  if (own == its)
  {
    return true;
  }
  const std::vector<Vector3d> corners = cornersOf(*this, view);
  return !corners.empty() && own->Center() == its->Center() &&
    corners == cornersOf(other, otherView);
}

FieldScope FreespaceUnion::Root() const
{
  FieldScope scope;
  scope.views = this->AllViews;
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
        this->Views.size(), this->Hull().Bounds(),
        [this](std::size_t view, const Eigen::AlignedBox3d& box)
        { return VoteOn(*this->Views[view], box, this->MarginOf(static_cast<int>(view))); },
        this->Votes.enough, deepestLevel, progress);
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
        this->Views.size(), this->Hull().Bounds(),
        [this](std::size_t view, const Eigen::AlignedBox3d& box)
        { return this->Views[view]->MayClaim(box) ? Vote::Undecided : Vote::None; },
        this->Votes.enough, deepestLevel);
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
    scope.votes = part.votes;
  }
  return scope;
}

// Asks views, some of which have voted, until the decision is certain.
bool FreespaceUnion::IsVotedFree(
  const Vector3d& point, VoteCount votes, const int* begin, const int* end) const
{
  for (const int* view = begin; view != end; ++view)
  {
    const BoxContent decision = this->Votes.Decide(votes, static_cast<std::size_t>(end - view));
    if (decision != BoxContent::Mixed)
    {
      return decision == BoxContent::Free;
    }
    votes.Add(VoteOn(*this->Views[*view], point, this->MarginOf(*view)));
  }
  return this->Votes.IsFree(votes);
}

bool FreespaceUnion::IsSeenFree(const Vector3d& point) const
{
  if (this->Views.size() <= FewViews || !this->Hull().Bounds().contains(point))
  {
    return this->IsVotedFree(
      point, {}, this->AllViews.data(), this->AllViews.data() + this->AllViews.size());
  }
  const ViewOctree::Part part = this->FreeIndex().At(point);
  return this->IsVotedFree(point, part.votes, part.begin, part.end);
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
  const std::vector<int>& views = scope.views;
  return this->Hull().IsEmpty() ||
    this->IsVotedFree(point, scope.votes, views.data(), views.data() + views.size()) ||
    std::any_of(scope.planes.begin(), scope.planes.end(),
      [&](int plane) { return this->Hull().Distance(plane, point) > 0; });
}

// Lets views vote on all of a box, and keeps those that are undecided.
template <typename Question>
BoxContent FreespaceUnion::VoteOnBox(
  const std::vector<int>& views, FieldScope& scope, const Question& question) const
{
  std::vector<int> open;
  VoteCount votes = scope.votes;
  for (const int view : views)
  {
    const Vote vote = question(view);
    if (vote == Vote::Undecided)
    {
      open.push_back(view);
    }
    votes.Add(vote);
    if (votes.free >= this->Votes.enough)
    {
      return BoxContent::Free;
    }
  }
  scope.views = std::move(open);
  scope.votes = votes;
  const BoxContent content = this->Votes.Decide(votes, scope.views.size());
  // The planes of the hull can still make a point free.
  return content == BoxContent::Matter && !scope.planes.empty() ? BoxContent::Mixed : content;
}

BoxContent FreespaceUnion::Classify(
  const Eigen::AlignedBox3d& box, const FieldScope& parent, FieldScope& scope) const
{
  if (this->Hull().IsEmpty() ||
    this->Votes.Decide(parent.votes, parent.views.size()) == BoxContent::Free)
  {
    return BoxContent::Free;
  }
  const BoxContent hull = this->Hull().Classify(box, parent.planes, scope.planes);
  scope.views.clear();
  scope.votes = parent.votes;
  if (hull == BoxContent::Free)
  {
    return BoxContent::Free;
  }
  return this->VoteOnBox(parent.views, scope,
    [&](int view) { return VoteOn(*this->Views[view], box, this->MarginOf(view)); });
}

BoxContent FreespaceUnion::ClassifyFinely(const Eigen::AlignedBox3d& box, FieldScope& scope) const
{
  const std::vector<int> views = std::move(scope.views);
  return this->VoteOnBox(views, scope,
    [&](int view) { return VoteFinely(*this->Views[view], box, this->MarginOf(view)); });
}

}
