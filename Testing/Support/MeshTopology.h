// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_MeshTopology_h
#define freespace_MeshTopology_h

#include "Contour/BisectionContour.h"

#include <map>
#include <string>

namespace freespace
{

/// What is wrong with a mesh that should be closed, 2-manifold, consistently oriented and without
/// degenerate triangles, also after its points are rounded to single precision. Empty: nothing.
inline std::string TopologyFaults(const ContourMesh& mesh)
{
  std::map<std::array<float, 3>, int> places;
  std::vector<int> merged;
  for (const Eigen::Vector3d& p : mesh.points)
  {
    const Eigen::Vector3f f = p.cast<float>();
    merged.push_back(
      places.emplace(std::array<float, 3>{ f.x(), f.y(), f.z() }, places.size()).first->second);
  }
  if (places.size() != mesh.points.size())
  {
    return "coinciding vertices";
  }
  std::map<std::pair<int, int>, int> next; // half edge to the triangle's third corner
  std::vector<int> degree(mesh.points.size(), 0);
  for (const auto& triangle : mesh.triangles)
  {
    for (int i = 0; i < 3; ++i)
    {
      const int a = triangle[i], b = triangle[(i + 1) % 3], c = triangle[(i + 2) % 3];
      if (a == b || !next.emplace(std::make_pair(a, b), c).second)
      {
        return "a doubled edge";
      }
      ++degree[a];
    }
    const Eigen::Vector3f p = mesh.points[triangle[0]].cast<float>(),
                          q = mesh.points[triangle[1]].cast<float>(),
                          r = mesh.points[triangle[2]].cast<float>();
    if (!((q - p).cross(r - p).norm() > 0))
    {
      return "a triangle without area";
    }
  }
  std::vector<char> seen(mesh.points.size(), 0);
  for (const auto& [edge, third] : next)
  {
    if (!next.count({ edge.second, edge.first }))
    {
      return "a border edge";
    }
    if (!seen[edge.first])
    {
      // Around the vertex: one closed fan has all its triangles.
      seen[edge.first] = 1;
      int steps = 0, at = edge.second;
      do
      {
        at = next.at({ edge.first, at });
        ++steps;
      } while (at != edge.second);
      if (steps != degree[edge.first])
      {
        return "a vertex where two fans meet";
      }
    }
  }
  for (int d : degree)
  {
    if (d == 0)
    {
      return "a vertex without triangles";
    }
  }
  return "";
}

/// Positive where normals point out of the enclosed volume.
inline double EnclosedVolume(const ContourMesh& mesh)
{
  double volume = 0.0;
  for (const auto& t : mesh.triangles)
  {
    volume += mesh.points[t[0]].dot(mesh.points[t[1]].cross(mesh.points[t[2]])) / 6.0;
  }
  return volume;
}

}

#endif
