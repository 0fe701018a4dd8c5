// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ViewOctree_h
#define freespace_ViewOctree_h

#include "Common/Progress.h"
#include "Freespace/Votes/ViewVotes.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace freespace
{

/// An octree over a box, whose nodes list the views for which a question is not decided in the
/// whole node. Of a thousand views of a landscape, a few are undecided around a point.
class ViewOctree
{
public:
  /// The vote on a box of the view with an index.
  using Question = std::function<Vote(std::size_t view, const Eigen::AlignedBox3d&)>;

  /// Nodes that are free in `enough` views are not split, nor those on the deepest level. The
  /// progress is the fraction of the box that is done; throws Aborted when the progress asks to
  /// stop.
  ViewOctree(std::size_t views, const Eigen::AlignedBox3d& box, const Question& question,
    int enough, int deepestLevel, const Progress& progress = {});

  /// The views of a part of the box.
  struct Part
  {
    VoteCount votes;  ///< of the views that are of one opinion in all of the part
    const int* begin; ///< the views that are not decided in it
    const int* end;
  };

  /// The smallest part that contains a point of the box.
  Part At(const Eigen::Vector3d& point) const;

  /// The smallest part that contains another box, which must be inside this one.
  Part Around(const Eigen::AlignedBox3d& box) const;

  bool Contains(const Eigen::AlignedBox3d& box) const { return this->Box.contains(box); }
  bool Contains(const Eigen::Vector3d& point) const { return this->Box.contains(point); }

  std::size_t NumberOfParts() const { return this->Nodes.size(); }

private:
  struct Node
  {
    int first = -1; ///< of eight children
    VoteCount votes;
    std::size_t begin = 0, end = 0; ///< in Undecided
  };

  void Split(const Question& question, std::size_t node, const Eigen::AlignedBox3d& box);
  Part PartOf(const Node& node) const;

  Eigen::AlignedBox3d Box;
  std::vector<Node> Nodes;
  std::vector<int> Undecided;
};

}

#endif
