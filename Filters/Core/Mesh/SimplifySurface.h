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

/// Options of the simplification.
struct SimplifyOptions
{
  double bound = 0.0;    ///< of the distance between the two surfaces, in their unit; > 0
  bool isSingle = false; ///< whether points are rounded to single precision

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// Triangles with one label each.
struct LabelledSurface
{
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int64_t> labels; ///< per triangle; may be empty
};

/// Removes vertices where the surface is flat, by edge collapses (CGAL's surface mesh
/// simplification, with the cost and placement of Lindstrom and Turk).
///
/// The library does not bound the distance, so each collapse is checked: the removed triangles and
/// those that replace them have the same border, and both are height functions over a common plane;
/// the greatest difference of the two functions, which is at a vertex or where two edges cross,
/// bounds the distance in both directions. These distances add up over repeated collapses; the sum
/// stays within the bound.
///
/// Borders, and edges between triangles with different labels, are kept. The surface keeps its
/// topology, and no self-intersections arise: a collapse that would create one is skipped.
/// The same for any number of threads.
///
/// Throws Error when the triangles are not a 2-manifold, Aborted when the progress asks to stop.
LabelledSurface SimplifySurface(const LabelledSurface& surface, const SimplifyOptions& options,
  const Progress& progress = {}, const ParallelFor& parallelFor = SerialFor);

}

#endif
