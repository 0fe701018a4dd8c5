// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Fit/NormalFilter.h"

#include "Common/Error.h"
#include "Mesh/Fit/NormalMixer.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

// Iterations of the smoothing of the guide normals, and the factor of its deviation.
constexpr int GuideIterations = 4;
constexpr double GuideWidth = 2;

}

void NormalFilterOptions::Check() const
{
  if (this->iterations < 0)
  {
    throw Error("The iterations of the normals' filter must not be negative.");
  }
  if (!(this->deviation > 0) || !std::isfinite(this->deviation))
  {
    throw Error("The deviation of the normals' filter must be positive.");
  }
}

void TriangleNormals(const std::vector<Vector3d>& points,
  const std::vector<std::array<std::int32_t, 3>>& triangles, std::vector<Vector3d>& normals,
  std::vector<double>& areas, const ParallelFor& parallelFor)
{
  normals.resize(triangles.size());
  areas.resize(triangles.size());
  parallelFor(triangles.size(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t t = begin; t < end; ++t)
      {
        const auto& [a, b, c] = triangles[t];
        const Vector3d cross = (points[b] - points[a]).cross(points[c] - points[a]);
        const double length = cross.norm();
        areas[t] = 0.5 * length;
        normals[t] = length > 0 ? Vector3d(cross / length) : Vector3d::Zero();
      }
    });
}

void FilterNormals(std::vector<Vector3d>& normals, const std::vector<double>& areas,
  const MeshEdges& edges, const NormalFilterOptions& options, const ParallelFor& parallelFor)
{
  if (options.iterations == 0)
  {
    return;
  }
  const NormalMixer mixer(areas, edges);
  NormalMixer::Normals smooth = NormalMixer::FromVectors(normals), guides, mixed;
  for (int i = 0; i < options.iterations; ++i)
  {
    guides = smooth;
    // Later rounds have little noise left: the normals are their own guides.
    for (int j = 0; j < GuideIterations && 2 * i < options.iterations; ++j)
    {
      mixer.Mix(guides, guides, GuideWidth * options.deviation, mixed, parallelFor);
      guides.swap(mixed);
    }
    mixer.Mix(smooth, guides, options.deviation, mixed, parallelFor);
    smooth.swap(mixed);
  }
  for (std::size_t t = 0; t < normals.size(); ++t)
  {
    const Vector3d normal(smooth[0][t], smooth[1][t], smooth[2][t]);
    const double length = normal.norm();
    normals[t] = length > 0 ? Vector3d(normal / length) : normals[t];
  }
}

}
