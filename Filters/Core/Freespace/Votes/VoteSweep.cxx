// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/Votes/VoteSweep.h"

#include <algorithm>
#include <tuple>

namespace freespace
{

using Eigen::Vector3d;

bool VoteSweep::Change::operator<(const Change& other) const
{
  return std::tie(this->place, this->view, this->free, this->reach) <
    std::tie(other.place, other.view, other.free, other.reach);
}

VoteSweep::VoteSweep(VoteCount votes)
  : Free(votes.free)
  , Reach(votes.free + votes.against)
  , Now(votes)
{
}

void VoteSweep::Add(int view, const ViewFreespace& freespace, const Vector3d& first,
  const Vector3d& last, double margin)
{
  thread_local ViewFreespace::Intervals intervals;
  const bool canBeAgainst = margin > 0;
  freespace.FreeIntervals(first, last, intervals);
  for (const auto& [begin, end] : intervals)
  {
    this->Changes.push_back({ begin, 1, canBeAgainst ? 0 : 1, view });
    this->Changes.push_back({ end, -1, canBeAgainst ? 0 : -1, view });
  }
  if (canBeAgainst)
  {
    freespace.FreeIntervals(
      Nearer(freespace, first, margin), Nearer(freespace, last, margin), intervals);
    for (const auto& [begin, end] : intervals)
    {
      this->Changes.push_back({ begin, 0, 1, view });
      this->Changes.push_back({ end, 0, -1, view });
    }
  }
}

bool VoteSweep::Next()
{
  constexpr double together = 1e-9;
  if (!this->IsSorted)
  {
    std::sort(this->Changes.begin(), this->Changes.end());
    this->IsSorted = true;
  }
  if (this->Done == this->Changes.size())
  {
    return false;
  }
  this->Begun = -1;
  this->At = this->Changes[this->Done].place;
  for (;
       this->Done < this->Changes.size() && this->Changes[this->Done].place <= this->At + together;
       ++this->Done)
  {
    const Change& change = this->Changes[this->Done];
    this->Free += change.free;
    this->Reach += change.reach;
    this->Begun = change.free > 0 ? change.view : this->Begun;
  }
  this->Now = { this->Free, this->Reach - this->Free };
  return true;
}

}
