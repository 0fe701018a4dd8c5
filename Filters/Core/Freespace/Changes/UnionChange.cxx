// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/Changes/UnionChange.h"

namespace freespace
{

namespace
{

// Matches two sequences in their order: each element of the first with the next equal one of the second.
template <typename AreSame, typename OnMatch, typename OnGone, typename OnNew>
void MatchInOrder(int countBefore, int countNow, AreSame&& areSame, OnMatch&& onMatch,
  OnGone&& onGone, OnNew&& onNew)
{
  int next = 0; // of those now that are not matched
  for (int i = 0; i < countBefore; ++i)
  {
    int j = next;
    while (j < countNow && !areSame(i, j))
    {
      ++j;
    }
    if (j == countNow)
    {
      onGone(i);
      continue;
    }
    onMatch(i, j);
    for (; next < j; ++next)
    {
      onNew(next);
    }
    ++next;
  }
  for (; next < countNow; ++next)
  {
    onNew(next);
  }
}

}

UnionChange::UnionChange(
  std::shared_ptr<const FreespaceUnion> before, std::shared_ptr<const FreespaceUnion> now)
  : Before(std::move(before))
  , After(std::move(now))
{
  const VoteRule &ruleBefore = this->Before->Rule(), &ruleNow = this->After->Rule();
  this->All.isEverything = this->Before->Hull().IsEmpty() || this->After->Hull().IsEmpty() ||
    ruleBefore.enough != ruleNow.enough || ruleBefore.isMajority != ruleNow.isMajority;
  this->MatchViews();
  this->MatchPlanes();
}

// Whether two views have the same opinion everywhere, and the same name in labels.
bool UnionChange::AreSame(int before, int now) const
{
  const int mapBefore = this->Before->MapOf(before), mapNow = this->After->MapOf(now);
  const bool areMaps = mapBefore == before && mapNow == now;
  return this->Before->MarginOf(before) == this->After->MarginOf(now) &&
    this->Before->HasSameView(before, *this->After, now) &&
    (areMaps || (mapBefore != before && mapNow != now && this->ViewNow(mapBefore) == mapNow));
}

// In their order, which decides where two views are equally near.
void UnionChange::MatchViews()
{
  const int countBefore = static_cast<int>(this->Before->Root().views.size());
  const int countNow = static_cast<int>(this->After->Root().views.size());
  const auto add = [this](const FreespaceUnion& phi, int view)
  {
    this->All.views.push_back(static_cast<int>(this->Changed.size()));
    this->Changed.push_back({ &phi.ViewAt(static_cast<std::size_t>(view)), phi.MarginOf(view) });
  };
  this->Now.assign(static_cast<std::size_t>(countBefore), -1);
  MatchInOrder(
    countBefore, countNow, [this](int i, int j) { return this->AreSame(i, j); },
    [this](int i, int j) { this->Now[static_cast<std::size_t>(i)] = j; },
    [&](int i) { add(*this->Before, i); }, [&](int j) { add(*this->After, j); });
}

// In their order, too.
void UnionChange::MatchPlanes()
{
  const FeatureHull &before = this->Before->Hull(), &now = this->After->Hull();
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  const auto areSame = [&](int i, int j)
  {
    return before.Normal(i) == now.Normal(j) &&
      before.Distance(i, origin) == now.Distance(j, origin);
  };
  MatchInOrder(
    before.NumberOfPlanes(), now.NumberOfPlanes(), areSame, [](int, int) {},
    [this](int i) { this->All.planesBefore.push_back(i); },
    [this](int j) { this->All.planesNow.push_back(j); });
}

bool UnionChange::Leaves(
  const Eigen::AlignedBox3d& box, const ChangeScope& parent, ChangeScope& scope) const
{
  scope = {};
  scope.isEverything = parent.isEverything;
  for (std::size_t i = 0; i < parent.views.size() && !scope.isEverything; ++i)
  {
    const ChangedView& changed = this->Changed[static_cast<std::size_t>(parent.views[i])];
    switch (VoteOn(*changed.view, box, changed.margin))
    {
      case Vote::None:
        break;
      case Vote::Undecided:
        scope.views.push_back(parent.views[i]);
        break;
      default: // It counts in all of the box, and is not asked again.
        scope.isEverything = true;
    }
  }
  if (scope.isEverything)
  {
    return false;
  }
  // Of a box outside of a plane the others are not told.
  scope.isEverything = this->Before->Hull().Classify(
                         box, parent.planesBefore, scope.planesBefore) == BoxContent::Free ||
    this->After->Hull().Classify(box, parent.planesNow, scope.planesNow) == BoxContent::Free;
  return !scope.isEverything && scope.views.empty() && scope.planesBefore.empty() &&
    scope.planesNow.empty();
}

}
