// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/Votes/ViewVotes.h"

namespace freespace
{

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

namespace
{

// By what a view says of a place, and of the same place nearer to it: the free space is star-shaped, so that a place
// that is free is free nearer, too.
template <typename Classify>
Vote VoteOfBox(
  const ViewFreespace& view, const AlignedBox3d& box, double margin, const Classify& classify)
{
  switch (classify(box))
  {
    case BoxContent::Free:
      return Vote::Free;
    case BoxContent::Mixed:
      return Vote::Undecided;
    case BoxContent::Matter:
      break;
  }
  if (!(margin > 0))
  {
    return Vote::None;
  }
  const BoxContent nearer = classify(Nearer(view, box, margin));
  return nearer == BoxContent::Free ? Vote::Against
    : nearer == BoxContent::Matter  ? Vote::None
                                    : Vote::Undecided;
}

}

Vector3d Nearer(const ViewFreespace& view, const Vector3d& point, double margin)
{
  return view.Center() + (point - view.Center()) / (1 + margin);
}

AlignedBox3d Nearer(const ViewFreespace& view, const AlignedBox3d& box, double margin)
{
  return { Nearer(view, box.min(), margin), Nearer(view, box.max(), margin) };
}

Vote VoteOn(const ViewFreespace& view, const Vector3d& point, double margin)
{
  if (view.IsFree(point))
  {
    return Vote::Free;
  }
  return margin > 0 && view.IsFree(Nearer(view, point, margin)) ? Vote::Against : Vote::None;
}

Vote VoteOn(const ViewFreespace& view, const AlignedBox3d& box, double margin)
{
  return VoteOfBox(
    view, box, margin, [&view](const AlignedBox3d& asked) { return view.Classify(asked); });
}

Vote VoteFinely(const ViewFreespace& view, const AlignedBox3d& box, double margin)
{
  return VoteOfBox(
    view, box, margin, [&view](const AlignedBox3d& asked) { return view.ClassifyFinely(asked); });
}

}
