// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_NormalMixer_h
#define freespace_NormalMixer_h

#include "Common/ParallelFor.h"
#include "Mesh/Fit/MeshEdges.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace freespace
{

/// Averages the normals of triangles with those beside them. Several triangles at once, therefore an array for each
/// coordinate, with a zero behind the last triangle for what lies beyond a border; single precision, whose error is far
/// below the noise.
class NormalMixer
{
public:
  using Normals = std::array<std::vector<float>, 3>;

  /// The areas are weights, up to a common factor.
  NormalMixer(const std::vector<double>& areas, const MeshEdges& edges);

  static Normals FromVectors(const std::vector<Eigen::Vector3d>& normals);

  /// The average of each normal and its neighbours', weighted by areas and by the similarity of their guides: like a
  /// Gaussian of the deviation, but it ends at 2.4 deviations. A normal whose average is zero stays.
  void Mix(const Normals& normals, const Normals& guides, double deviation, Normals& mixed,
    const ParallelFor& parallelFor) const;

private:
  std::vector<float> Areas;
  std::array<std::vector<std::int32_t>, 3> Beside; // per triangle, the neighbours
};

}

#endif
