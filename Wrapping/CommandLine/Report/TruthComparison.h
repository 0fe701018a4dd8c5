// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_TruthComparison_h
#define freespace_TruthComparison_h

#include "Common/Camera.h"

#include <array>
#include <vector>

class vtkPolyData;

namespace freespace
{

/// How close a surface is to the truth, where cameras see the truth and the method can recover it: by the rays
/// through a lattice of each camera's pixels whose true point lies in the convex hull of the features.
/// Errors are along the ray, surface minus truth; distances are from points to the nearest point of the
/// other surface.
struct TruthFigures
{
  std::size_t rays = 0;
  double medianDepth = 0;               ///< of the true points
  std::array<double, 3> limits{};       ///< 0.1, 0.2 and 0.5 % of the median depth
  double covered = 0;                   ///< share of rays that hit the surface at all
  double medianError = 0;               ///< of the errors without sign of those that hit
  std::array<double, 3> within{};       ///< share of rays whose error is less than each limit
  double carved = 0;                    ///< share more than the last limit behind the truth
  double bulging = 0;                   ///< share more than the last limit in front of it
  std::array<double, 3> accuracy{};     ///< share of the surface's points so near to the truth
  std::array<double, 3> completeness{}; ///< share of the truth's points so near to the surface

  /// The harmonic mean of accuracy and completeness.
  double F(int limit) const;
};

/// Throws Error when no ray counts. Uses at most about 60,000 rays.
TruthFigures CompareWithTruth(vtkPolyData* surface, vtkPolyData* truth,
  const std::vector<Camera>& cameras, const std::vector<Eigen::Vector3d>& features);

}

#endif
