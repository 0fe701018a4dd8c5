// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_TriangleIntersections_h
#define freespace_TriangleIntersections_h

#include "Common/ParallelFor.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace freespace
{

/// A mesh as its corners' positions and its triangles.
struct TriangleSoup
{
  std::function<Eigen::Vector3d(std::int32_t vertex)> position;
  const std::int32_t* triangles = nullptr; ///< three corners each
  std::size_t count = 0;
};

/// All pairs of triangles, one of them a suspect, that meet otherwise than in the corners and edges
/// that they share; and each suspect without area, paired with itself. In ascending order, the lesser
/// of each pair first. Only pairs of which mayMeet says so are looked at; it is called by all
/// threads. Exact. The grid's cells should be about as large as the triangles.
std::vector<std::pair<std::size_t, std::size_t>> FindIntersections(const TriangleSoup& mesh,
  const std::vector<std::size_t>& suspects, double gridCell,
  const std::function<bool(std::size_t a, std::size_t b)>& mayMeet,
  const ParallelFor& parallelFor = SerialFor);

}

#endif
