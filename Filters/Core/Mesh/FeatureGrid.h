// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_FeatureGrid_h
#define freespace_FeatureGrid_h

#include <Eigen/Geometry>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace freespace
{

/// Tells whether a place is near a feature: a hash of cubic cells. Constant time for a place where the features
/// are about as dense as the reach is wide.
class FeatureGrid
{
public:
  /// The reach is in the points' unit; >= 0. Points that are not finite are left out.
  FeatureGrid(const std::vector<Eigen::Vector3d>& points, double reach);

  /// Whether a feature is no farther than the reach.
  bool IsNear(const Eigen::Vector3d& place) const;

private:
  using Index = Eigen::Matrix<std::int64_t, 3, 1>;
  Index CellOf(const Eigen::Vector3d& place) const;
  static std::uint64_t KeyOf(const Index& cell);

  double Reach;
  double Side; ///< of a cell, twice the reach
  Eigen::Vector3d Origin = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> Points;                                              ///< by cell
  std::unordered_map<std::uint64_t, std::pair<std::uint32_t, std::uint32_t>> Cells; ///< in Points
};

}

#endif
