// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SurfaceSummary_h
#define freespace_SurfaceSummary_h

#include "Mesh/TriangleMesh.h"

#include <Eigen/Geometry>

#include <cstdint>

namespace freespace
{

/// What a mesh of triangles is.
struct SurfaceSummary
{
  std::int64_t points = 0, triangles = 0;
  std::int64_t unusedPoints = 0;  ///< of no triangle
  std::int64_t flatTriangles = 0; ///< without area
  std::int64_t components = 0;    ///< connected by points
  std::int64_t edges = 0;         ///< pairs of points, each once
  std::int64_t borderEdges = 0;   ///< of one triangle
  std::int64_t crowdedEdges = 0;  ///< of three triangles or more
  std::int64_t contraryEdges = 0; ///< of two triangles that are oriented unlike each other
  double area = 0;
  double volume = 0; ///< enclosed, positive where normals point outwards; of a closed surface only
  Eigen::AlignedBox3d bounds; ///< of the points that triangles use

  bool IsClosed() const { return this->borderEdges == 0 && this->triangles > 0; }
  /// Whether each edge has two triangles at most. Points where two fans of triangles meet are not looked for.
  bool HasManifoldEdges() const { return this->crowdedEdges == 0; }
  /// Points used - edges + triangles.
  std::int64_t EulerCharacteristic() const
  {
    return this->points - this->unusedPoints - this->edges + this->triangles;
  }
};

/// O(n log n) for n triangles.
SurfaceSummary Summarize(const TriangleMesh& mesh);

}

#endif
