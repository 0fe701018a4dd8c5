// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/DelaunayDisparity.h"

#include "Common/Error.h"
#include "Support/FeatureViews.h"
#include "Support/Core/MapEdges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

using namespace freespace;
using Eigen::Vector2d;

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
