// SPDX-License-Identifier: BSD-3-Clause
// DelaunayDisparity against the definition of section 2.1 by brute force.
#include "Disparity/DelaunayDisparity.h"

#include "Support/FeatureViews.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

using namespace freespace;

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

using Delaunay = CGAL::Delaunay_triangulation_2<Kernel,
  CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>>>;

using Triangles = std::set<std::array<double, 12>>;

// A triangle as coordinates and source of its corners, so that sets of them compare whatever the
// order.
std::array<double, 12> Corners(const std::vector<Eigen::Vector3d>& points,
  const std::vector<int>& sourceView, std::array<int, 3> triangle)
{
  const auto key = [&](int i)
  {
    return std::array<double, 4>{ points[i].x(), points[i].y(), points[i].z(),
      static_cast<double>(sourceView[i]) };
  };
  std::array<double, 12> corners;
  const auto smallest = std::min_element(
    triangle.begin(), triangle.end(), [&key](int a, int b) { return key(a) < key(b); });
  std::rotate(triangle.begin(), smallest, triangle.end());
  for (int i = 0; i < 12; ++i)
  {
    corners[i] = key(triangle[i / 4])[i % 4];
  }
  return corners;
}

Triangles SetOfTriangles(const DisparityMap& map)
{
  Triangles triangles;
  for (const auto& triangle : map.triangles)
  {
    triangles.insert(Corners(map.points, map.sourceView, triangle));
  }
  return triangles;
}

// The definition of section 2.1, without any cleverness: triangulate from scratch, look at every
// point, insert the highest, and so on.
struct BruteForce
{
  std::vector<Eigen::Vector3d> points; // of the triangulation
  std::vector<int> sourceView;
  Triangles triangles;

  BruteForce(const std::vector<View>& views, std::size_t index, double tolerance)
    : Camera(views[index].camera)
  {
    for (const Eigen::Vector3d& point : views[index].points)
    {
      this->Add(point, static_cast<int>(index));
    }
    this->Triangulate();
    const Delaunay own = this->Current;
    while (this->InsertHighest(views, index, own, tolerance))
    {
      this->Triangulate();
    }
    for (const auto& face : this->Current.finite_face_handles())
    {
      this->triangles.insert(Corners(this->points, this->sourceView,
        { face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info() }));
    }
  }

private:
  Kernel::Point_2 Pixel(const Eigen::Vector3d& point) const
  {
    const Eigen::Vector2d pixel = this->Camera.Project(point);
    return { pixel.x(), pixel.y() };
  }

  // A point that coincides with another in the image takes its place when it is nearer.
  void Add(const Eigen::Vector3d& point, int view)
  {
    for (std::size_t i = 0; i < this->points.size(); ++i)
    {
      if (this->Pixel(this->points[i]) == this->Pixel(point))
      {
        if (this->Camera.Depth(point) < this->Camera.Depth(this->points[i]))
        {
          this->points[i] = point;
          this->sourceView[i] = view;
        }
        return;
      }
    }
    this->points.push_back(point);
    this->sourceView.push_back(view);
  }

  void Triangulate()
  {
    this->Current.clear();
    for (std::size_t i = 0; i < this->points.size(); ++i)
    {
      this->Current.insert(this->Pixel(this->points[i]))->info() = static_cast<int>(i);
    }
  }

  double Height(const Eigen::Vector3d& point) const
  {
    const Kernel::Point_2 pixel = this->Pixel(point);
    const auto face = this->Current.locate(pixel);
    double disparity = 0, sum = 0;
    for (int i = 0; i < 3; ++i)
    {
      const double weight = CGAL::area(
        pixel, face->vertex(Delaunay::ccw(i))->point(), face->vertex(Delaunay::cw(i))->point());
      disparity += weight / this->Camera.Depth(this->points[face->vertex(i)->info()]);
      sum += weight;
    }
    return 1 / this->Camera.Depth(point) - disparity / sum;
  }

  bool InsertHighest(
    const std::vector<View>& views, std::size_t index, const Delaunay& own, double tolerance)
  {
    double highest = 0;
    const Eigen::Vector3d* best = nullptr;
    int bestView = 0;
    for (std::size_t v = 0; v < views.size(); ++v)
    {
      for (const Eigen::Vector3d& point : views[v].points)
      {
        if (v == index || this->Inserted.count(&point) || this->Camera.Depth(point) <= 0 ||
          !this->Camera.Sees(this->Camera.Project(point)) ||
          own.is_infinite(own.locate(this->Pixel(point))))
        {
          continue;
        }
        const double height = this->Height(point);
        if (height > tolerance / this->Camera.Depth(point) && height > highest)
        {
          highest = height;
          best = &point;
          bestView = static_cast<int>(v);
        }
      }
    }
    if (best)
    {
      this->Add(*best, bestView);
      this->Inserted.insert(best);
    }
    return best;
  }

  freespace::Camera Camera;
  Delaunay Current;
  std::set<const Eigen::Vector3d*> Inserted;
};

void ExpectDefinition(const std::vector<View>& views, std::size_t index, double tolerance)
{
  DelaunayDisparityOptions options;
  options.tolerance = tolerance;
  options.spatialFlips = false;
  const DisparityMap map = TriangulateView(views, index, options);
  const BruteForce expected(views, index, tolerance);
  EXPECT_EQ(map.points.size(), expected.points.size());
  EXPECT_TRUE(SetOfTriangles(map) == expected.triangles);
}

}

TEST(DelaunayDisparity, IsTheDefinitionOnRandomViews)
{
  for (unsigned int seed = 0; seed < 200; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<View> views = RandomViews(seed);
    ExpectDefinition(views, 0, seed % 2 ? 0.0 : 0.01);
    ExpectDefinition(views, 1, seed % 2 ? 0.0 : 0.01);
  }
}

TEST(DelaunayDisparity, IsTheDefinitionOnEdgesAndVertices)
{
  for (unsigned int seed = 0; seed < 200; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    ExpectDefinition(LatticeViews(seed), 0, 1e-6);
  }
}
