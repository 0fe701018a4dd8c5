// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/ViewOctree.h"

#include "Common/Octant.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace freespace
{

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

namespace
{

// Limits of the number of nodes and of their lists' length: some tens of megabytes at most.
constexpr std::size_t MostNodes = 1 << 17;
constexpr std::size_t MostUndecided = 1 << 23;

// Evaluating this number of views costs no more than another level.
constexpr std::size_t LeafViews = 1;

}

ViewOctree::ViewOctree(std::size_t views, const AlignedBox3d& box, const Question& question,
  int enough, int deepestLevel, const Progress& progress)
  : Box(box)
  , Undecided(views)
{
  std::iota(this->Undecided.begin(), this->Undecided.end(), 0);
  this->Nodes.push_back({ -1, {}, 0, views });
  // Breadth first, so that all places are resolved equally well when the limits are reached.
  std::vector<std::pair<std::size_t, AlignedBox3d>> level = { { 0, box } };
  double settled = 0.0;
  for (int depth = 0; depth < deepestLevel && !level.empty(); ++depth)
  {
    const double share = std::pow(0.125, depth);
    std::vector<std::pair<std::size_t, AlignedBox3d>> next;
    for (const auto& [node, part] : level)
    {
      const std::size_t undecided = this->Nodes[node].end - this->Nodes[node].begin;
      if (undecided <= LeafViews || this->Nodes[node].votes.free >= enough ||
        this->Nodes.size() + 8 > MostNodes || this->Undecided.size() > MostUndecided)
      {
        settled += share;
        continue;
      }
      settled += depth + 1 == deepestLevel ? share : 0.0;
      progress(std::min(settled, 1.0));
      this->Split(question, node, part);
      for (int corner = 0; corner < 8; ++corner)
      {
        next.emplace_back(this->Nodes[node].first + corner, Octant(part, corner));
      }
    }
    level = std::move(next);
  }
  progress(1.0);
}

void ViewOctree::Split(const Question& question, std::size_t node, const AlignedBox3d& box)
{
  this->Nodes[node].first = static_cast<int>(this->Nodes.size());
  for (int corner = 0; corner < 8; ++corner)
  {
    const AlignedBox3d part = Octant(box, corner);
    Node child{ -1, this->Nodes[node].votes, this->Undecided.size(), 0 };
    for (std::size_t i = this->Nodes[node].begin; i < this->Nodes[node].end; ++i)
    {
      const int view = this->Undecided[i];
      const Vote vote = question(static_cast<std::size_t>(view), part);
      if (vote == Vote::Undecided)
      {
        this->Undecided.push_back(view);
      }
      child.votes.Add(vote);
    }
    child.end = this->Undecided.size();
    this->Nodes.push_back(child);
  }
}

ViewOctree::Part ViewOctree::PartOf(const Node& node) const
{
  return { node.votes, this->Undecided.data() + node.begin, this->Undecided.data() + node.end };
}

ViewOctree::Part ViewOctree::At(const Vector3d& point) const
{
  std::size_t node = 0;
  AlignedBox3d box = this->Box;
  while (this->Nodes[node].first >= 0)
  {
    const int corner = OctantOf(box, point);
    box = Octant(box, corner);
    node = this->Nodes[node].first + corner;
  }
  return this->PartOf(this->Nodes[node]);
}

ViewOctree::Part ViewOctree::Around(const AlignedBox3d& inner) const
{
  std::size_t node = 0;
  AlignedBox3d box = this->Box;
  while (this->Nodes[node].first >= 0)
  {
    const int corner = OctantOf(box, inner.min());
    box = Octant(box, corner);
    if (!box.contains(inner))
    {
      break;
    }
    node = this->Nodes[node].first + corner;
  }
  return this->PartOf(this->Nodes[node]);
}

}
