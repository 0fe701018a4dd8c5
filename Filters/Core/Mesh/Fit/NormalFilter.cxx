// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Fit/NormalFilter.h"

#include "Common/Error.h"

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

// Unit normals with a zero behind, so that they are added and compared as one vector of the processor. Single
// precision: its error is far below the noise.
using Normals = std::vector<Eigen::Vector4f>;

// Averages each normal with its neighbours', weighted by areas and by the similarity of their guides: like a Gaussian of
// the deviation, but it ends at 2.4 deviations.
void MixOnce(const Normals& normals, const Normals& guides, const std::vector<float>& areas,
  const MeshEdges& edges, double deviation, Normals& mixed, const ParallelFor& parallelFor)
{
  const auto scale = static_cast<float>(1 / (6 * deviation * deviation));
  parallelFor(normals.size(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t t = begin; t < end; ++t)
      {
        Eigen::Vector4f sum = areas[t] * normals[t];
        for (const int other : edges.opposite[t])
        {
          if (other >= 0)
          {
            const float x = std::max(0.f, 1 - scale * (guides[t] - guides[other]).squaredNorm());
            sum += x * x * x * areas[other] * normals[other];
          }
        }
        const float squared = sum.squaredNorm();
        mixed[t] = squared > 0 ? Eigen::Vector4f(sum / std::sqrt(squared)) : normals[t];
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
  if (options.iterations == 0)
  {
    return;
  }
  Normals smooth(normals.size()), guides, mixed(normals.size());
  std::vector<float> weights(areas.size());
  const double unit = areas.empty() ? 1 : *std::max_element(areas.begin(), areas.end());
  for (std::size_t t = 0; t < normals.size(); ++t)
  {
    smooth[t] << normals[t].cast<float>(), 0;
    weights[t] = static_cast<float>(unit > 0 ? areas[t] / unit : 0);
  }
  for (int i = 0; i < options.iterations; ++i)
  {
    guides = smooth;
    // Later rounds have little noise left: the normals are their own guides.
    for (int j = 0; j < GuideIterations && 2 * i < options.iterations; ++j)
    {
      MixOnce(guides, guides, weights, edges, GuideWidth * options.deviation, mixed, parallelFor);
      guides.swap(mixed);
    }
    MixOnce(smooth, guides, weights, edges, options.deviation, mixed, parallelFor);
    smooth.swap(mixed);
  }
  for (std::size_t t = 0; t < normals.size(); ++t)
  {
    const Vector3d normal = smooth[t].head<3>().cast<double>();
    const double length = normal.norm();
    normals[t] = length > 0 ? Vector3d(normal / length) : normals[t];
  }
}

}
