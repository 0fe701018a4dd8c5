// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/DelaunayDisparity.h"

#include "Common/Error.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <set>

using namespace freespace;
using Eigen::Vector2d;

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel,
  CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>>>;
using Triangles = std::set<std::array<double, 12>>;

View MakeView(double focalLength = 500)
{
  View view;
  view.name = "cluster";
  view.camera.K << focalLength, 0, 500, 0, focalLength, 500, 0, 0, 1;
  view.camera.width = view.camera.height = 1000;
  return view;
}

void AddFeature(View& view, const Eigen::Vector3d& point)
{
  view.points.push_back(point);
  view.imagePoints.push_back(view.camera.Project(point));
}

void AddFeature(View& view, const Eigen::Vector2d& pixel, double depth)
{
  AddFeature(view, view.camera.Unproject(pixel, depth));
}

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

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

// The disparity of the map at a pixel; none outside its triangles.
std::optional<double> DisparityAt(const DisparityMap& map, const Eigen::Vector2d& pixel)
{
  for (const auto& triangle : map.triangles)
  {
    double weight[3], sum = 0, disparity = 0;
    bool inside = true;
    for (int i = 0; i < 3; ++i)
    {
      const Eigen::Vector2d& a = map.imagePoints[triangle[(i + 1) % 3]];
      const Eigen::Vector2d& b = map.imagePoints[triangle[(i + 2) % 3]];
      weight[i] = Cross(a - pixel, b - pixel);
      inside = inside && weight[i] >= 0;
      sum += weight[i];
      disparity += weight[i] / map.camera.Depth(map.points[triangle[i]]);
    }
    if (inside)
    {
      return disparity / sum;
    }
  }
  return {};
}

bool IsFree(const DisparityMap& map, const Eigen::Vector3d& point)
{
  const std::optional<double> disparity = DisparityAt(map, map.camera.Project(point));
  return disparity && 1 / map.camera.Depth(point) > *disparity;
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
  const DisparityMap map = TriangulateView(views, index, options);
  const BruteForce expected(views, index, tolerance);
  EXPECT_EQ(map.points.size(), expected.points.size());
  EXPECT_TRUE(SetOfTriangles(map) == expected.triangles);
}

// Views all round a cloud of points of which each recovers some; every third is a smooth surface,
// so that few points stick out, every third a cloud, so that many do.
std::vector<View> RandomViews(unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<View> views;
  for (int v = 0; v < 3; ++v)
  {
    View view = MakeView();
    view.camera.R = Eigen::AngleAxisd(
      0.4 * unit(random), Eigen::Vector3d(unit(random), unit(random), unit(random)).normalized())
                      .matrix();
    view.camera.t = { 0, 0, 3 };
    const int count = 5 + static_cast<int>(random() % 60);
    for (int i = 0; i < count; ++i)
    {
      const double x = unit(random), y = unit(random), bump = std::cos(3 * x) * std::cos(3 * y);
      const double roughness = seed % 3 == 0 ? 1.0 : seed % 3 == 1 ? 0.1 : 0.01;
      AddFeature(view, Eigen::Vector3d(x, y, 0.3 * bump + roughness * unit(random)));
    }
    views.push_back(view);
  }
  return views;
}

// Points over whole pixels: many coincide, lie on edges and on circles through others.
std::vector<View> LatticeViews(unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> pixel(0, 8);
  // Of so few bits that each point projects exactly onto its pixel.
  std::uniform_int_distribution<long long> depth(1LL << 30, (1LL << 31) - 1);
  std::vector<View> views(2, MakeView(1));
  for (View& view : views)
  {
    view.camera.K << 1, 0, 0, 0, 1, 0, 0, 0, 1;
    for (int i = 0; i < 40; ++i)
    {
      AddFeature(
        view, Eigen::Vector2d(pixel(random), pixel(random)), depth(random) / double(1 << 30));
    }
  }
  return views;
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

namespace
{

bool HasEdge(const DisparityMap& map, int a, int b)
{
  return std::any_of(map.triangles.begin(), map.triangles.end(),
    [a, b](const std::array<int, 3>& t)
    { return std::count(t.begin(), t.end(), a) && std::count(t.begin(), t.end(), b); });
}

}

// Two features that are far apart along an edge, and a bridge that would cross it.
TEST(DelaunayDisparity, KeptEdgesAreNotCrossed)
{
  std::vector<View> views(2, MakeView());
  for (const Vector2d& pixel :
    { Vector2d(100, 500), Vector2d(900, 500), Vector2d(500, 450), Vector2d(500, 560) })
  {
    AddFeature(views[0], pixel, pixel.y() == 500 ? 1 : 2);
  }
  views[0].edges = { { 0, 1 } };
  DelaunayDisparityOptions options;
  EXPECT_TRUE(HasEdge(TriangulateView(views, 0, options), 2, 3)) << "the bridge";
  options.keepEdges = true;
  const DisparityMap kept = TriangulateView(views, 0, options);
  EXPECT_TRUE(HasEdge(kept, 0, 1));
  EXPECT_FALSE(HasEdge(kept, 2, 3));

  views[0].edges = { { 2, 3 }, { 0, 1 }, { 0, 0 } }; // the second crosses the first
  EXPECT_TRUE(HasEdge(TriangulateView(views, 0, options), 2, 3));
}

// Inserting into a constrained triangulation must keep hold of every point: nothing sticks out, and the
// edges are still there, perhaps in pieces.
TEST(DelaunayDisparity, KeptEdgesUnderTheConstraint)
{
  for (unsigned int seed = 0; seed < 100; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::vector<View> views = seed % 2 ? LatticeViews(seed) : RandomViews(seed);
    const int count = static_cast<int>(views[0].points.size());
    for (int i = 0; i + 1 < count; i += 3)
    {
      views[0].edges.push_back({ i, i + 1 });
    }
    DelaunayDisparityOptions options;
    options.keepEdges = true;
    options.tolerance = 1e-6;
    const DisparityMap map = TriangulateView(views, 0, options);
    for (const View& view : views)
    {
      for (const Eigen::Vector3d& point : view.points)
      {
        if (const auto disparity = DisparityAt(map, map.camera.Project(point)))
        {
          EXPECT_LE(1 / map.camera.Depth(point), *disparity * (1 + 1e-5));
        }
      }
    }
  }
}

TEST(DelaunayDisparity, NothingSticksOut)
{
  const std::vector<View> views = RandomViews(3);
  DelaunayDisparityOptions options;
  options.tolerance = 0.001;
  const DisparityMap map = TriangulateView(views, 0, options);
  int counted = 0;
  for (const View& view : views)
  {
    for (const Eigen::Vector3d& point : view.points)
    {
      if (const auto disparity = DisparityAt(map, map.camera.Project(point)))
      {
        ++counted;
        EXPECT_LE(
          (1 / map.camera.Depth(point) - *disparity) * map.camera.Depth(point), 0.001 + 1e-9);
      }
    }
  }
  EXPECT_GT(counted, 20);
}

// Figure 4: a folded sheet. Cluster 1 misses its ridge P; cluster 2 has P; cluster 3 sees the sheet
// from behind and recovers Q there, which is hidden from cluster 1.
namespace
{

struct FoldedSheet
{
  std::vector<View> views = std::vector<View>(3, MakeView());

  FoldedSheet()
  {
    for (double y = -1.5; y <= 1.5; y += 0.125)
    {
      AddFeature(this->views[0], Eigen::Vector3d(-1.5, y, 5));
      AddFeature(this->views[0], Eigen::Vector3d(1.5, y, 5));
    }
    for (double y = -1; y <= 1; y += 0.0625)
    {
      AddFeature(this->views[1], Eigen::Vector3d(0.25, y, 4));
      AddFeature(this->views[2], Eigen::Vector3d(0.25, y, 4.7));
    }
  }

  // How much of the front half of the sheet a map takes for free space.
  double Carved(const DisparityMap& map) const
  {
    int carved = 0, count = 0;
    for (double y = -0.5; y <= 0.5; y += 0.05)
    {
      for (double s = 0.05; s < 1; s += 0.1)
      {
        const double x = 0.25 + s * 1.25, z = 4 + s;
        carved += IsFree(map, { x, y, z + 0.01 }) + IsFree(map, { 0.5 - x, y, z + 0.15 });
        count += 2;
      }
    }
    return static_cast<double>(carved) / count;
  }
};

}

TEST(DelaunayDisparity, Figure4MissedFeatureIsSupplied)
{
  const FoldedSheet sheet;
  DelaunayDisparityOptions options;
  options.minimumDisparity = false;
  const DisparityMap missed = TriangulateView(sheet.views, 0, options);
  EXPECT_GT(sheet.Carved(missed), 0.8) << "the figure needs a view that misses the ridge";

  options.minimumDisparity = true;
  const DisparityMap greedy = TriangulateView(sheet.views, 0, options);
  EXPECT_EQ(sheet.Carved(greedy), 0);
  EXPECT_GT(std::count(greedy.sourceView.begin(), greedy.sourceView.end(), 1), 0);
  EXPECT_EQ(std::count(greedy.sourceView.begin(), greedy.sourceView.end(), 2), 0);
}

TEST(DelaunayDisparity, Figure4AddingAllThatViolateIsTooLiberal)
{
  FoldedSheet sheet;
  DelaunayDisparityOptions options;
  options.minimumDisparity = false;
  const DisparityMap missed = TriangulateView(sheet.views, 0, options);
  int hidden = 0;
  for (int v = 1; v <= 2; ++v)
  {
    for (const Eigen::Vector3d& point : sheet.views[v].points)
    {
      if (IsFree(missed, point))
      {
        AddFeature(sheet.views[0], point);
        hidden += v == 2;
      }
    }
  }
  ASSERT_GT(hidden, 0);
  EXPECT_GT(sheet.Carved(TriangulateView(sheet.views, 0, options)), 0.2);
}

// Figure 5: each cluster recovers two occluding contours of a cylinder without features.
TEST(DelaunayDisparity, Figure5FeaturelessCylinder)
{
  constexpr int clusters = 8;
  const double pi = std::acos(-1.0), distance = 6, tangent = std::acos(1 / distance);
  std::vector<View> views(clusters, MakeView());
  std::vector<double> contour; // angles on the cylinder
  for (int v = 0; v < clusters; ++v)
  {
    const double angle = 2 * pi * v / clusters;
    const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0), up(0, 0, 1);
    Camera& camera = views[v].camera;
    camera.R << up.cross(out).transpose(), -up.transpose(), -out.transpose();
    camera.t = -camera.R * (distance * out);
    for (const double side : { -tangent, tangent })
    {
      contour.push_back(angle + side);
      for (double z = -2; z <= 2; z += 0.1)
      {
        AddFeature(views[v], Eigen::Vector3d(std::cos(angle + side), std::sin(angle + side), z));
      }
    }
  }
  std::sort(contour.begin(), contour.end(),
    [pi](double a, double b) { return std::remainder(a, 2 * pi) < std::remainder(b, 2 * pi); });

  DelaunayDisparityOptions options;
  options.tolerance = 1e-9;
  const std::vector<DisparityMap> constrained = TriangulateViews(views, options);
  options.minimumDisparity = false;
  const std::vector<DisparityMap> unconstrained = TriangulateViews(views, options);
  const auto freeInAny = [](const std::vector<DisparityMap>& maps, const Eigen::Vector3d& point)
  {
    return std::any_of(
      maps.begin(), maps.end(), [&point](const DisparityMap& map) { return IsFree(map, point); });
  };
  int carved = 0;
  for (std::size_t i = 0; i < contour.size(); ++i) // the sides of the recovered polygon
  {
    const double a = contour[i], b = contour[(i + 1) % contour.size()];
    const Eigen::Vector3d begin(std::cos(a), std::sin(a), 0), end(std::cos(b), std::sin(b), 0);
    for (double s = 0.05; s < 1; s += 0.1)
    {
      const Eigen::Vector3d side = begin + s * (end - begin) + Eigen::Vector3d(0, 0, 0.03);
      EXPECT_FALSE(freeInAny(constrained, 0.99 * side)) << "side " << i << " at " << s;
      EXPECT_TRUE(freeInAny(constrained, 1.01 * side)) << "side " << i << " at " << s;
      carved += freeInAny(unconstrained, 0.99 * side);
    }
  }
  EXPECT_GT(carved, 50) << "without the constraint the cylinder should be cut into";
}

TEST(DelaunayDisparity, PointsThatDoNotCount)
{
  std::vector<View> views(2, MakeView());
  for (const Eigen::Vector2d& pixel :
    { Eigen::Vector2d(100, 100), Eigen::Vector2d(900, 100), Eigen::Vector2d(500, 900) })
  {
    AddFeature(views[0], pixel, 2);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  views[1].points = { views[1].camera.Unproject({ 500, 500 }, -1), // behind
    Eigen::Vector3d::Zero(),                                       // at the centre
    views[1].camera.Unproject({ 110, 800 }, 1),                    // outside the triangle
    views[1].camera.Unproject({ 2000, 500 }, 1),                   // outside the image
    { nan, 0, 1 }, { 0, 0, nan }, { infinity, 0, 1 }, { 0, 0, infinity },
    views[1].camera.Unproject({ 500, 400 }, 2.1),      // below the surface
    views[1].camera.Unproject({ 500, 400 }, 1.9999) }; // above by less than the tolerance
  views[1].imagePoints.resize(views[1].points.size());
  const DisparityMap map = TriangulateView(views, 0, DelaunayDisparityOptions());
  EXPECT_EQ(map.points, views[0].points);
  EXPECT_EQ(map.triangles.size(), 1u);

  views[1].points.push_back(views[1].camera.Unproject({ 500, 400 }, 1.99));
  EXPECT_EQ(TriangulateView(views, 0, DelaunayDisparityOptions()).points.size(), 4u);
}

TEST(DelaunayDisparity, PointOnAVertexReplacesIt)
{
  std::vector<View> views(2, MakeView(1));
  views[0].camera.K << 1, 0, 0, 0, 1, 0, 0, 0, 1;
  views[1].camera = views[0].camera;
  for (const Eigen::Vector2d& pixel :
    { Eigen::Vector2d(1, 1), Eigen::Vector2d(9, 1), Eigen::Vector2d(5, 9) })
  {
    AddFeature(views[0], pixel, 2);
  }
  AddFeature(views[1], Eigen::Vector2d(9, 1), 1);
  const DisparityMap map = TriangulateView(views, 0, DelaunayDisparityOptions());
  EXPECT_EQ(map.triangles.size(), 1u);
  EXPECT_EQ(map.sourceView, (std::vector<int>{ 0, 1, 0 }));
  EXPECT_EQ(map.points[1], views[1].points[0]);
}

TEST(DelaunayDisparity, DuplicateFeaturesKeepTheNearest)
{
  std::vector<View> views(1, MakeView());
  for (const double depth : { 2.0, 1.0, 4.0 })
  {
    AddFeature(views[0], Eigen::Vector2d(500, 500), depth);
  }
  AddFeature(views[0], Eigen::Vector2d(500, 200), 1);
  AddFeature(views[0], Eigen::Vector2d(200, 500), 1);
  const DisparityMap map = TriangulateView(views, 0, DelaunayDisparityOptions());
  ASSERT_EQ(map.points.size(), 3u);
  EXPECT_EQ(map.points[0], views[0].points[1]);
}

TEST(DelaunayDisparity, TrianglesAreCounterClockwise)
{
  const DisparityMap map = TriangulateView(RandomViews(1), 0, DelaunayDisparityOptions());
  ASSERT_FALSE(map.triangles.empty());
  for (const auto& triangle : map.triangles)
  {
    const Eigen::Vector2d& origin = map.imagePoints[triangle[0]];
    EXPECT_GT(
      Cross(map.imagePoints[triangle[1]] - origin, map.imagePoints[triangle[2]] - origin), 0);
  }
}

namespace
{

void ExpectError(const std::vector<View>& views, const std::string& fault)
{
  try
  {
    TriangulateViews(views, DelaunayDisparityOptions());
    FAIL() << "no error";
  }
  catch (const Error& error)
  {
    EXPECT_NE(std::string(error.what()).find(fault), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("'poor'"), std::string::npos) << error.what();
  }
}

}

TEST(DelaunayDisparity, TooFewFeatures)
{
  std::vector<View> views = { RandomViews(1)[0], MakeView() };
  views[1].name = "poor";
  ExpectError(views, "0 usable features");
  AddFeature(views[1], Eigen::Vector2d(100, 100), 1);
  ExpectError(views, "1 usable feature");
  AddFeature(views[1], Eigen::Vector2d(200, 100), 1);
  AddFeature(views[1], Eigen::Vector2d(200, 100), -1);
  ExpectError(views, "2 usable features");
}

TEST(DelaunayDisparity, CollinearOrCoincidentFeatures)
{
  std::vector<View> views = { RandomViews(1)[0], MakeView() };
  views[1].name = "poor";
  for (int i = 0; i < 5; ++i)
  {
    AddFeature(views[1], Eigen::Vector3d(0, 0.1 * i, 1));
  }
  ExpectError(views, "collinear");
  views[1].points.assign(5, Eigen::Vector3d(0, 0, 1));
  ExpectError(views, "collinear");
}

TEST(DelaunayDisparity, NoViews)
{
  EXPECT_TRUE(TriangulateViews({}, DelaunayDisparityOptions()).empty());
}

TEST(DelaunayDisparity, OptionsOutOfRange)
{
  DelaunayDisparityOptions options;
  options.tolerance = -1;
  EXPECT_THROW(TriangulateViews({}, options), Error);
  options.tolerance = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(TriangulateViews({}, options), Error);
}

TEST(DelaunayDisparity, CanBeAborted)
{
  const Progress stop([](double) { return false; });
  EXPECT_THROW(
    TriangulateViews(RandomViews(1), DelaunayDisparityOptions(), SerialFor, stop), Aborted);
}
