// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_PatchComparison_h
#define freespace_PatchComparison_h

#include <Eigen/Geometry>

#include <array>
#include <vector>

namespace freespace
{

/// Compares two patches of triangles with the same border as height functions over a common plane.
class PatchComparison
{
public:
  using Triangles = std::vector<std::array<Eigen::Vector3d, 3>>;
  struct Segment
  {
    Eigen::Vector3d from, to;
  };

  /// Chooses the plane across the mean normal of the first patch. False when a triangle of either
  /// patch is too steep over it.
  bool Begin(const Triangles& before, const Triangles& after);

  /// Whether none of the triangles is too thin.
  static bool HaveShape(const Triangles& triangles);

  /// Whether the triangles around a point wind around it once.
  bool GoAroundOnce(const Triangles& fan, const Eigen::Vector3d& center) const;

  /// The distance of a point to the triangles along the plane's normal.
  double HeightAbove(const Triangles& triangles, const Eigen::Vector3d& point) const;

  /// The distance of two segments where they cross in the plane; 0 where they do not.
  double GapAtCrossing(const Segment& s, const Segment& t) const;

private:
  Eigen::Vector3d Local(const Eigen::Vector3d& p) const;
  static double Turn(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

  Eigen::Vector3d Up, U, V; ///< orthonormal
};

}

#endif
