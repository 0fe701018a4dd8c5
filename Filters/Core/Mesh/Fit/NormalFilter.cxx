// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Fit/NormalFilter.h"

#include "Common/Error.h"

#include <Eigen/Geometry>

#include <cmath>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

// Iterations of the smoothing of the guide normals, and the factor of its deviation.
constexpr int GuideIterations = 4;
constexpr double GuideWidth = 2;

// Like a Gaussian of the deviation, but it ends at 2.4 deviations.
double MixingWeight(const Vector3d& a, const Vector3d& b, double deviation)
{
  const double x = 1 - (a - b).squaredNorm() / (6 * deviation * deviation);
  return x > 0 ? x * x * x : 0.0;
}

// Averages each normal with its neighbours', weighted by the similarity of their guides.
void MixOnce(const std::vector<Vector3d>& normals, const std::vector<Vector3d>& guides,
  const std::vector<double>& areas, const MeshEdges& edges, double deviation,
  std::vector<Vector3d>& mixed, const ParallelFor& parallelFor)
{
  parallelFor(normals.size(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t t = begin; t < end; ++t)
      {
        Vector3d sum = areas[t] * normals[t];
        for (const int other : edges.opposite[t])
        {
          if (other >= 0)
          {
            sum +=
              MixingWeight(guides[t], guides[other], deviation) * areas[other] * normals[other];
          }
        }
        const double length = sum.norm();
        mixed[t] = length > 0 ? Vector3d(sum / length) : normals[t];
      }
    });
}

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
  std::vector<Vector3d> guides, mixed(normals.size());
  for (int i = 0; i < options.iterations; ++i)
  {
    guides = normals;
    // Later rounds have little noise left: the normals are their own guides.
    for (int j = 0; j < GuideIterations && 2 * i < options.iterations; ++j)
    {
      MixOnce(guides, guides, areas, edges, GuideWidth * options.deviation, mixed, parallelFor);
      guides.swap(mixed);
    }
    MixOnce(normals, guides, areas, edges, options.deviation, mixed, parallelFor);
    normals.swap(mixed);
  }
}

}
