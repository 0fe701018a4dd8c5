// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SimplifySurface_h
#define freespace_SimplifySurface_h

#include "Common/ParallelFor.h"
#include "Common/Progress.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace freespace
{

/// How a surface is simplified.
struct SimplifyOptions
{
  double bound = 0.0;    ///< no point of either surface is further from the other, in its unit; > 0
  bool isSingle = false; ///< points are to be exact in single precision

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// Triangles with a label each.
struct LabelledSurface
{
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int64_t> labels; ///< per triangle; may be empty
};

/// Leaves out vertices where the surface is flat, by collapsing edges (CGAL's surface mesh
/// simplification, with Lindstrom's and Turk's cost and placement).
///
/// The library bounds no distance, so each collapse is held against the bound: the triangles that go
/// and those that come in their place have the same border, and both are over the plane across their
/// mean normal like a function; the greatest difference of the two functions, which is at a vertex or
/// where two edges cross, bounds the distance both ways. These distances add up over what collapses at
/// a place; the sum stays within the bound.
///
/// Borders, and edges between triangles with different labels, stay as they are. The surface keeps its
/// topology, and meets itself nowhere if it did not before: wherever it would, it is left as it was.
/// The same for any number of threads.
///
/// Throws Error when the triangles are not a 2-manifold, Aborted when the progress wants to stop.
LabelledSurface SimplifySurface(const LabelledSurface& surface, const SimplifyOptions& options,
  const Progress& progress = {}, const ParallelFor& parallelFor = SerialFor);

}

#endif
