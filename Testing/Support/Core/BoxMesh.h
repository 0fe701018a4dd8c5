// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BoxMesh_h
#define freespace_BoxMesh_h

#include "Contour/Lattice/ContourMesh.h"
#include "Mesh/TriangleIntersections.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace freespace
{

/// Half the side of the cube of BoxMesh.
constexpr double BoxHalf = 0.6;

/// A cube whose faces are squares of two triangles each, with vertices on its edges and corners.
inline ContourMesh BoxMesh(int cells = 16)
{
  ContourMesh mesh;
  std::map<std::array<int, 3>, std::int32_t> known;
  const auto vertex = [&](const std::array<int, 3>& at)
  {
    const auto place = known.emplace(at, static_cast<std::int32_t>(mesh.points.size()));
    if (place.second)
    {
      mesh.points.push_back(
        BoxHalf * (2.0 / cells * Eigen::Vector3d(at[0], at[1], at[2]) - Eigen::Vector3d::Ones()));
    }
    return place.first->second;
  };
  for (int face = 0; face < 6; ++face)
  {
    const int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int i = 0; i < cells; ++i)
    {
      for (int j = 0; j < cells; ++j)
      {
        std::int32_t corners[4];
        for (int k = 0; k < 4; ++k)
        {
          std::array<int, 3> at;
          at[axis] = face % 2 ? cells : 0;
          at[u] = i + (k == 1 || k == 2);
          at[v] = j + (k >= 2);
          corners[k] = vertex(at);
        }
        if (face % 2 == 0)
        {
          std::swap(corners[1], corners[3]);
        }
        mesh.triangles.push_back({ corners[0], corners[1], corners[2] });
        mesh.triangles.push_back({ corners[0], corners[2], corners[3] });
      }
    }
  }
  return mesh;
}

/// Moves points at random, each in its own direction.
inline void AddNoise(std::vector<Eigen::Vector3d>& points, double deviation)
{
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, deviation);
  for (Eigen::Vector3d& p : points)
  {
    p += Eigen::Vector3d(noise(random), noise(random), noise(random));
  }
}

/// Pairs of triangles that intersect, and triangles without area.
inline std::size_t CountIntersections(const std::vector<Eigen::Vector3d>& points,
  const std::vector<std::array<std::int32_t, 3>>& triangles)
{
  TriangleSoup soup;
  soup.position = [&](std::int32_t v) { return points[v]; };
  soup.triangles = triangles.front().data();
  soup.count = triangles.size();
  std::vector<std::size_t> all(triangles.size());
  std::iota(all.begin(), all.end(), 0);
  return FindIntersections(soup, all, 0.1, [](std::size_t, std::size_t) { return true; }).size();
}

}

#endif
