// SPDX-License-Identifier: BSD-3-Clause
// Where the surface of the union crosses a segment, and what it is there: Crossing and Label.
#include "Freespace/FreespaceUnion.h"
#include "Freespace/Votes/VoteSweep.h"

#include <cmath>

namespace freespace
{

using Eigen::Vector3d;

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
  const bool isFreeForOne = this->Votes.enough == 1 && !this->Votes.isMajority;
  if (isFreeForOne)
  {
    this->FirstFree(matter, free, scope, place, label);
  }
  else
  {
    this->FirstVotedFree(matter, free, scope, place, label);
  }
  return place >= 0 && place <= 1;
}

// Finds the first place on a segment, before the given one, that any view has free, and labels the surface there: the
// paper's union.
void FreespaceUnion::FirstFree(const Vector3d& matter, const Vector3d& free,
  const FieldScope& scope, double& place, SurfaceLabel& label) const
{
  thread_local ViewFreespace::Intervals intervals;
  int opener = -1;
  for (const int view : scope.views)
  {
    this->Views[view]->FreeIntervals(matter, free, intervals);
    if (!intervals.empty() && intervals.front().first < place)
    {
      place = intervals.front().first;
      opener = view;
    }
  }
  if (opener >= 0)
  {
    label =
      this->OfMaps(this->LabelOfView(opener, matter + place * (free - matter), free - matter));
  }
}

// The label of the surface where a view's free interval begins, seen from matter.
SurfaceLabel FreespaceUnion::LabelOfView(
  int view, const Vector3d& crossing, const Vector3d& towardsFree) const
{
  const ViewFreespace& opener = *this->Views[view];
  const double step = 1e-6;
  const ViewFreespace::Sample sample = opener.At(crossing);
  // On the map the value is zero up to rounding; on a silhouette wall it is the height above the
  // map.
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

// Nobody saw the surroundings of a camera: their border is a wall of its view.
SurfaceLabel FreespaceUnion::OfMaps(SurfaceLabel label) const
{
  const int maps = static_cast<int>(this->Maps.size());
  if (label.view >= maps)
  {
    label.view = this->AddedView[label.view - maps];
    label.kind = SurfaceKind::Wall;
  }
  return label;
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
  // The view that is free on one side and not on the other, with the greatest value.
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
  if (label.view < 0 && greatest == 0.0)
  {
    label = this->LabelOfContradiction(free, matter, scope);
  }
  return this->OfMaps(label);
}

// Finds the first place on a segment, before the given one, where the votes make it free, and labels the surface there.
void FreespaceUnion::FirstVotedFree(const Vector3d& matter, const Vector3d& free,
  const FieldScope& scope, double& place, SurfaceLabel& label) const
{
  VoteSweep sweep(scope.votes);
  for (const int view : scope.views)
  {
    sweep.Add(view, *this->Views[view], matter, free, this->MarginOf(view));
  }
  while (sweep.Next() && sweep.Place() < place)
  {
    if (!this->Votes.IsFree(sweep.Votes()))
    {
      continue;
    }
    place = sweep.Place();
    const Vector3d crossing = matter + place * (free - matter);
    const Vector3d step = 1e-6 * (free - matter);
    label = sweep.Opener() >= 0
      ? this->LabelOfView(sweep.Opener(), crossing, free - matter)
      : this->LabelOfContradiction(crossing + step, crossing - step, scope);
    label = this->OfMaps(label);
    return;
  }
}

// The surface where a view ceases to contradict that a place is free, a little behind its map. Nobody saw it: it is a
// wall.
SurfaceLabel FreespaceUnion::LabelOfContradiction(
  const Vector3d& free, const Vector3d& matter, const FieldScope& scope) const
{
  SurfaceLabel label;
  for (const int view : scope.views)
  {
    const ViewFreespace& own = *this->Views[view];
    const double margin = this->MarginOf(view);
    if (VoteOn(own, matter, margin) == Vote::Against && VoteOn(own, free, margin) == Vote::None)
    {
      const ViewFreespace::Sample sample = own.At(Nearer(own, free, margin));
      return { view, SurfaceKind::Wall,
        sample.triangle >= 0 ? Vector3d(-sample.gradient.normalized())
                             : Vector3d(-own.WallNormal(matter, free)) };
    }
  }
  return label;
}

}
