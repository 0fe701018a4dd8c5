// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/SurfaceSummary.h"

#include "Mesh/SurfaceComponents.h"

#include <algorithm>
#include <tuple>

namespace freespace
{

namespace
{

struct HalfEdge
{
  int low, high;
  bool isForward; ///< from the lower number to the higher

  bool IsOf(const HalfEdge& other) const
  {
    return this->low == other.low && this->high == other.high;
  }
};

std::vector<HalfEdge> SortedEdges(const TriangleMesh& mesh)
{
  std::vector<HalfEdge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles)
  {
    for (int i = 0; i < 3; ++i)
    {
      const int from = triangle[i], to = triangle[(i + 1) % 3];
      edges.push_back({ std::min(from, to), std::max(from, to), from < to });
    }
  }
  std::sort(edges.begin(), edges.end(),
    [](const HalfEdge& a, const HalfEdge& b)
    { return std::tie(a.low, a.high) < std::tie(b.low, b.high); });
  return edges;
}

void CountEdges(const TriangleMesh& mesh, SurfaceSummary& summary)
{
  const std::vector<HalfEdge> edges = SortedEdges(mesh);
  for (std::size_t begin = 0; begin < edges.size();)
  {
    std::size_t end = begin + 1;
    while (end < edges.size() && edges[end].IsOf(edges[begin]))
    {
      ++end;
    }
    ++summary.edges;
    summary.borderEdges += end - begin == 1 ? 1 : 0;
    summary.crowdedEdges += end - begin > 2 ? 1 : 0;
    summary.contraryEdges +=
      end - begin == 2 && edges[begin].isForward == edges[begin + 1].isForward ? 1 : 0;
    begin = end;
  }
}

}

SurfaceSummary Summarize(const TriangleMesh& mesh)
{
  SurfaceSummary summary;
  summary.points = static_cast<std::int64_t>(mesh.points.size());
  summary.triangles = static_cast<std::int64_t>(mesh.triangles.size());
  std::vector<char> isUsed(mesh.points.size(), 0);
  std::vector<std::array<std::int64_t, 3>> corners;
  for (const auto& triangle : mesh.triangles)
  {
    corners.push_back({ triangle[0], triangle[1], triangle[2] });
    for (int corner : triangle)
    {
      isUsed[corner] = 1;
      summary.bounds.extend(mesh.points[corner]);
    }
  }
  summary.unusedPoints = std::count(isUsed.begin(), isUsed.end(), 0);
  for (std::int32_t component : ComponentsOf(corners, summary.points))
  {
    summary.components = std::max<std::int64_t>(summary.components, component + 1);
  }
  CountEdges(mesh, summary);
  const Eigen::Vector3d middle =
    mesh.triangles.empty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(summary.bounds.center());
  for (const auto& [a, b, c] : mesh.triangles)
  {
    const Eigen::Vector3d p = mesh.points[a] - middle, q = mesh.points[b] - middle,
                          r = mesh.points[c] - middle;
    const double area = (q - p).cross(r - p).norm() / 2;
    summary.flatTriangles += area > 0 ? 0 : 1;
    summary.area += area;
    summary.volume += p.dot(q.cross(r)) / 6;
  }
  summary.volume = summary.IsClosed() ? summary.volume : 0;
  return summary;
}

}
