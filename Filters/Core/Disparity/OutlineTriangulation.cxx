// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/OutlineTriangulation.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

namespace freespace
{

using Eigen::Vector2d;

namespace
{

using OutlineKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using OutlineVertex = CGAL::Triangulation_vertex_base_with_info_2<int, OutlineKernel>;
using OutlineFace = CGAL::Constrained_triangulation_face_base_2<OutlineKernel>;
using Storage = CGAL::Triangulation_data_structure_2<OutlineVertex, OutlineFace>;
using Triangulation =
  CGAL::Constrained_Delaunay_triangulation_2<OutlineKernel, Storage, CGAL::Exact_predicates_tag>;

constexpr int notYetAPoint = -1;

Triangulation Triangulate(const std::vector<Outline>& outlines)
{
  Triangulation triangulation;
  for (const Outline& outline : outlines)
  {
    std::vector<Triangulation::Point> points;
    points.reserve(outline.size());
    for (const Vector2d& point : outline)
    {
      points.emplace_back(point.x(), point.y());
    }
    triangulation.insert_constraint(points.begin(), points.end(), true);
  }
  for (const auto vertex : triangulation.finite_vertex_handles())
  {
    vertex->info() = notYetAPoint;
  }
  return triangulation;
}

}

PlanarTriangles TriangulateOutlines(
  const std::vector<Outline>& outlines, const std::function<bool(const Vector2d&)>& isInside)
{
  const Triangulation triangulation = Triangulate(outlines);
  PlanarTriangles result;
  if (triangulation.dimension() < 2)
  {
    return result;
  }
  const auto indexOf = [&result](Triangulation::Vertex_handle vertex)
  {
    if (vertex->info() == notYetAPoint)
    {
      vertex->info() = static_cast<int>(result.points.size());
      result.points.emplace_back(vertex->point().x(), vertex->point().y());
    }
    return vertex->info();
  };
  for (const auto face : triangulation.finite_face_handles())
  {
    Vector2d centroid = Vector2d::Zero();
    for (int corner = 0; corner < 3; ++corner)
    {
      const auto& point = face->vertex(corner)->point();
      centroid += Vector2d(point.x(), point.y()) / 3;
    }
    if (isInside(centroid))
    {
      result.triangles.push_back(
        { indexOf(face->vertex(0)), indexOf(face->vertex(1)), indexOf(face->vertex(2)) });
    }
  }
  return result;
}

}
