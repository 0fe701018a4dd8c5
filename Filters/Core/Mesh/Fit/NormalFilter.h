// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_NormalFilter_h
#define freespace_NormalFilter_h

#include "Common/ParallelFor.h"
#include "Mesh/Fit/MeshEdges.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace freespace
{

/// Options of the smoothing of normals.
struct NormalFilterOptions
{
  int iterations = 18; ///< each mixes a triangle's normal with those beside it; >= 0
  double deviation =
    0.35; ///< normals that differ by more than about two of it do not mix: the length
          ///< of the difference of unit normals; > 0

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// The unit normals of triangles (zero without area) and their areas.
void TriangleNormals(const std::vector<Eigen::Vector3d>& points,
  const std::vector<std::array<std::int32_t, 3>>& triangles, std::vector<Eigen::Vector3d>& normals,
  std::vector<double>& areas, const ParallelFor& parallelFor = SerialFor);

/// Smooths the normals of a mesh, except across its sharp edges: bilateral filtering in the manner of
/// Zheng, Fu, Au and Tai, "Bilateral Normal Filtering for Mesh Denoising" (TVCG 2011). The
/// weight of a neighbour depends on the difference of guide normals that are smoothed once more (a joint
/// bilateral filter) and therefore little affected by the noise of single triangles.
void FilterNormals(std::vector<Eigen::Vector3d>& normals, const std::vector<double>& areas,
  const MeshEdges& edges, const NormalFilterOptions& options,
  const ParallelFor& parallelFor = SerialFor);

}

#endif
