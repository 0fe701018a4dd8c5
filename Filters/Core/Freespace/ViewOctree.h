// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ViewOctree_h
#define freespace_ViewOctree_h

#include "Common/Progress.h"
#include "ViewFreespace/ViewFreespace.h"

#include <functional>
#include <memory>
#include <vector>

namespace freespace
{

/// Which views have something to say about a place: an octree over a box, whose nodes keep the views
/// for which a question is not decided in all of the node. Of a thousand views of a landscape a few are
/// left around a point, however many there are.
class ViewOctree
{
public:
  using Views = std::vector<std::unique_ptr<ViewFreespace>>;

  /// What a view says about a box.
  using Question = std::function<BoxContent(const ViewFreespace&, const Eigen::AlignedBox3d&)>;

  /// Nodes that enough views see free are not split, nor those on the deepest level. The progress is
  /// the part of the box that has been settled; throws Aborted when it wants to stop.
  ViewOctree(const Views& views, const Eigen::AlignedBox3d& box, const Question& question,
    int enough, int deepestLevel, const Progress& progress = {});

  /// What is left of the views in a part of the box.
  struct Part
  {
    int freeViews;    ///< that see all of the part free
    const int* begin; ///< those that are not decided in it
    const int* end;
  };

  /// Of the smallest part that holds a point of the box.
  Part At(const Eigen::Vector3d& point) const;

  /// Of a part that holds another box, which is inside this one.
  Part Around(const Eigen::AlignedBox3d& box) const;

  bool Contains(const Eigen::AlignedBox3d& box) const { return this->Box.contains(box); }
  bool Contains(const Eigen::Vector3d& point) const { return this->Box.contains(point); }

  std::size_t NumberOfParts() const { return this->Nodes.size(); }

private:
  struct Node
  {
    int first = -1; ///< of eight children
    int freeViews = 0;
    std::size_t begin = 0, end = 0; ///< in Undecided
  };

  void Split(
    const Views& views, const Question& question, std::size_t node, const Eigen::AlignedBox3d& box);
  Part PartOf(const Node& node) const;

  Eigen::AlignedBox3d Box;
  std::vector<Node> Nodes;
  std::vector<int> Undecided;
};

}

#endif
