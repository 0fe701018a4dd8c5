// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_VoteSweep_h
#define freespace_VoteSweep_h

#include "Freespace/Votes/ViewVotes.h"

#include <cstddef>
#include <vector>

namespace freespace
{

/// The votes of views along a segment, from place to place where one changes. Changes closer than 1e-9 of the segment
/// are one: at a silhouette wall a view begins to be free and ceases to be against at once, up to rounding.
class VoteSweep
{
public:
  /// votes: of the views that are of one opinion on all of the segment.
  explicit VoteSweep(VoteCount votes);

  /// Adds a view, with the margin within which it votes against. Before Next.
  void Add(int view, const ViewFreespace& freespace, const Eigen::Vector3d& first,
    const Eigen::Vector3d& last, double margin);

  /// Goes on to the next change, at first to the first one. False: there is none.
  bool Next();

  double Place() const { return this->At; } ///< 0 at the segment's first point, 1 at the last one
  const VoteCount& Votes() const { return this->Now; } ///< after the change
  int Opener() const { return this->Begun; } ///< a view that begins to be free there; -1: none does

private:
  // A view begins (1) or ends (-1) to be free, or to reach, that is, to be free or against.
  struct Change
  {
    double place;
    int free, reach, view;
    bool operator<(const Change& other) const;
  };

  std::vector<Change> Changes;
  std::size_t Done = 0;
  bool IsSorted = false;
  double At = 0;
  int Free, Reach;
  VoteCount Now;
  int Begun = -1;
};

}

#endif
