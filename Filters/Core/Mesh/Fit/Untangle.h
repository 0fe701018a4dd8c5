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

/// Options of Untangle.
struct UntangleOptions
{
  double cell = 0;       ///< of the grid in which triangles are compared, about their size; > 0
  bool isSingle = false; ///< points are rounded to single precision
};

/// Moves displaced vertices back towards their previous positions, by halves, wherever the mesh intersects
/// itself or a triangle is degenerate. The result has no such fault that it did not have before. The same for
/// any number of threads. Throws Aborted when the progress requests it.
void Untangle(std::vector<Eigen::Vector3d>& points, const std::vector<Eigen::Vector3d>& original,
  const std::vector<std::array<std::int32_t, 3>>& triangles, const UntangleOptions& options,
  const Progress& progress = {}, const ParallelFor& parallelFor = SerialFor);

}

#endif
