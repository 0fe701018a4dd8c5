// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Untangle_h
#define freespace_Untangle_h

#include "Common/ParallelFor.h"
#include "Common/Progress.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace freespace
{

/// How a mesh that meets itself is taken back.
struct UntangleOptions
{
  double cell = 0;       ///< of the grid in which triangles are compared, about their size; > 0
  bool isSingle = false; ///< points are rounded to single precision
};

/// Takes vertices that were moved back towards where they were, by halves, wherever the mesh meets itself
/// or a triangle has lost its area. What is left has no such place that it did not have before. The same for any number
/// of threads. Throws Aborted when the progress wants to stop.
void Untangle(std::vector<Eigen::Vector3d>& points, const std::vector<Eigen::Vector3d>& original,
  const std::vector<std::array<std::int32_t, 3>>& triangles, const UntangleOptions& options,
  const Progress& progress = {}, const ParallelFor& parallelFor = SerialFor);

}

#endif
