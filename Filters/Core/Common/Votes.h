// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Votes_h
#define freespace_Votes_h

namespace freespace
{

/// What a view says of a place: nothing, that it is free, that it is matter closely behind the view's surface, or, of
/// all places of a box together, none of these.
enum class Vote
{
  None,
  Free,
  Against,
  Undecided
};

/// How many views have voted.
struct VoteCount
{
  int free = 0, against = 0;

  void Add(Vote vote)
  {
    this->free += vote == Vote::Free;
    this->against += vote == Vote::Against;
  }
};

}

#endif
