// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SurfaceSamples_h
#define freespace_SurfaceSamples_h

#include "Mesh/TriangleMesh.h"

#include <vector>

namespace freespace
{

struct SurfaceSample
{
  Eigen::Vector3d point;
  int triangle = -1;
};

/// Random points of a surface, each for an equal share of its area, in the order of the triangles; the same
/// ones in each call. None for a surface without area.
std::vector<SurfaceSample> SampleSurface(const TriangleMesh& mesh, int count);

}

#endif
