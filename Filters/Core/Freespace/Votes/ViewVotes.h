// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ViewVotes_h
#define freespace_ViewVotes_h

#include "Common/BoxContent.h"
#include "Common/Votes.h"
#include "ViewFreespace/ViewFreespace.h"

#include <Eigen/Geometry>

#include <cstddef>

namespace freespace
{

/// When a place is free by the votes of the views.
struct VoteRule
{
  int enough = 1;          ///< this number of views decide whatever the others say
  bool isMajority = false; ///< fewer decide where no more are against

  bool IsFree(VoteCount votes) const
  {
    return votes.free >= this->enough ||
      (this->isMajority && votes.free > 0 && votes.free >= votes.against);
  }

  /// The decision while a number of views are open, each of which may still vote in any way: Mixed where it depends on
  /// them.
  BoxContent Decide(VoteCount votes, std::size_t open) const
  {
    const int others = static_cast<int>(open);
    return this->IsFree({ votes.free, votes.against + others }) ? BoxContent::Free
      : this->IsFree({ votes.free + others, votes.against })    ? BoxContent::Mixed
                                                                : BoxContent::Matter;
  }
};

/// The point, or box, that is nearer to a view's centre by a margin: a view claims it as free where the place itself is
/// in front of the view's surface or behind it by less than the margin. margin: a fraction of the depth.
Eigen::Vector3d Nearer(const ViewFreespace& view, const Eigen::Vector3d& point, double margin);
Eigen::AlignedBox3d Nearer(
  const ViewFreespace& view, const Eigen::AlignedBox3d& box, double margin);

/// A view's vote on a point. With a margin of 0 no view is against.
Vote VoteOn(const ViewFreespace& view, const Eigen::Vector3d& point, double margin);

/// A view's vote on all points of a box. Conservative: Undecided, where it may be one.
Vote VoteOn(const ViewFreespace& view, const Eigen::AlignedBox3d& box, double margin);

/// The same by ViewFreespace::ClassifyFinely.
Vote VoteFinely(const ViewFreespace& view, const Eigen::AlignedBox3d& box, double margin);

}

#endif
