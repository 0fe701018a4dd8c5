// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/CenterIndex.h"

#include <algorithm>

#include <nanoflann.hpp>

namespace freespace
{

namespace
{

// The interface that nanoflann requires of a point set.
struct Cloud
{
  std::vector<Eigen::Vector3d> points;

  std::size_t kdtree_get_point_count() const { return this->points.size(); }
  double kdtree_get_pt(std::size_t index, std::size_t axis) const
  {
    return this->points[index][static_cast<Eigen::Index>(axis)];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const
  {
    return false;
  }
};

using KdTree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>,
  Cloud, 3, std::size_t>;

#if NANOFLANN_VERSION >= 0x150
using Match = nanoflann::ResultItem<std::size_t, double>;
using SearchOptions = nanoflann::SearchParameters;
#else
using Match = std::pair<std::size_t, double>;
using SearchOptions = nanoflann::SearchParams;
#endif

}

struct CenterIndex::Tree
{
  explicit Tree(std::vector<Eigen::Vector3d> centers)
    : cloud{ std::move(centers) }
    , index(3, this->cloud)
  {
    this->index.buildIndex();
  }

  Cloud cloud;
  KdTree index;
};

CenterIndex::CenterIndex(std::vector<Eigen::Vector3d> centers)
  : Impl(std::make_unique<Tree>(std::move(centers)))
{
}

CenterIndex::~CenterIndex() = default;

std::vector<int> CenterIndex::Nearest(const Eigen::Vector3d& query, std::size_t count) const
{
  std::vector<std::size_t> indices(std::min(count, this->Impl->cloud.points.size()));
  if (indices.empty())
  {
    return {};
  }
  std::vector<double> distances(indices.size());
  const std::size_t found =
    this->Impl->index.knnSearch(query.data(), indices.size(), indices.data(), distances.data());
  return { indices.begin(), indices.begin() + static_cast<std::ptrdiff_t>(found) };
}

std::vector<int> CenterIndex::Within(const Eigen::Vector3d& query, double radius) const
{
  if (this->Impl->cloud.points.empty())
  {
    return {};
  }
  std::vector<Match> matches;
  this->Impl->index.radiusSearch(query.data(), radius * radius, matches, SearchOptions());
  std::vector<int> indices;
  for (const Match& match : matches)
  {
    indices.push_back(static_cast<int>(match.first));
  }
  std::sort(indices.begin(), indices.end());
  return indices;
}

}
