// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_CenterIndex_h
#define freespace_CenterIndex_h

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace freespace
{

/// A spatial index of points, such as the centres of cameras, that may coincide.
class CenterIndex
{
public:
  explicit CenterIndex(std::vector<Eigen::Vector3d> centers);
  ~CenterIndex();
  CenterIndex(const CenterIndex&) = delete;
  CenterIndex& operator=(const CenterIndex&) = delete;

  /// The indices of the (at most) `count` points nearest to the query, the nearest first.
  std::vector<int> Nearest(const Eigen::Vector3d& query, std::size_t count) const;

  /// The indices of all points nearer to the query than the radius, in ascending order.
  std::vector<int> Within(const Eigen::Vector3d& query, double radius) const;

private:
  struct Tree;
  std::unique_ptr<Tree> Impl;
};

}

#endif
