// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/Background/BackgroundContinuation.h"

#include "Common/Error.h"
#include "Disparity/DelaunayDisparity.h"
#include "ViewFreespace/ViewFreespace.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace freespace;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

constexpr double WallDepth = 2, PlateDepth = 1, PlateHalf = 0.2;

View MakeTurnedView(double x, double yaw)
{
  View view;
  view.name = "cluster";
  view.camera.K << 1000, 0, 500, 0, 1000, 500, 0, 0, 1;
  view.camera.width = view.camera.height = 1000;
  view.camera.R = Eigen::AngleAxisd(yaw, Vector3d::UnitY()).matrix();
  view.camera.t = -view.camera.R * Vector3d(x, 0, 0);
  return view;
}

bool IsHiddenByPlate(const Camera& camera, const Vector3d& point)
{
  const Vector3d center = camera.Center();
  const Vector3d onPlate =
    center + (PlateDepth - center.z()) / (point.z() - center.z()) * (point - center);
  return onPlate.head<2>().cwiseAbs().maxCoeff() < PlateHalf;
}

// A square plate before a wall, from several sides. The plate has features along its border, the
// wall only here and there.
std::vector<View> PlateBeforeWall()
{
  std::vector<View> views = { MakeTurnedView(0, 0), MakeTurnedView(0.6, 0.3),
    MakeTurnedView(-0.6, -0.3) };
  for (View& view : views)
  {
    for (double s = -PlateHalf; s < PlateHalf; s += 0.01)
    {
      view.points.insert(view.points.end(),
        { Vector3d(s, -PlateHalf, PlateDepth), Vector3d(PlateHalf, s, PlateDepth),
          Vector3d(-s, PlateHalf, PlateDepth), Vector3d(-PlateHalf, -s, PlateDepth) });
    }
    for (double x = -0.75; x < 0.8; x += 0.25)
    {
      for (double y = -0.75; y < 0.8; y += 0.25)
      {
        const Vector3d point(x, y, WallDepth);
        if (!IsHiddenByPlate(view.camera, point))
        {
          view.points.push_back(point);
        }
      }
    }
    for (const Vector3d& point : view.points)
    {
      view.imagePoints.push_back(view.camera.Project(point));
    }
  }
  return views;
}

// How much of what the central view sees close around the plate's right border, near the wall, is free.
double FreeBesidePlate(const DisparityMap& map)
{
  const ViewFreespace freespace(map);
  int free = 0, count = 0;
  for (double y = -0.15; y <= 0.15; y += 0.01)
  {
    for (double depth = 1.7; depth < 1.98; depth += 0.05)
    {
      const Vector2d pixel = map.camera.Project({ PlateHalf + 0.01, y, PlateDepth });
      free += freespace.IsFree(map.camera.Unproject(pixel, depth));
      ++count;
    }
  }
  return static_cast<double>(free) / count;
}

// Behind each side of the plate one other view looks.
BackgroundOptions OneRefutes()
{
  BackgroundOptions options;
  options.views = 1;
  return options;
}

}

TEST(ContinueBackground, BehindAnEdgeTheWallGoesOn)
{
  const std::vector<View> views = PlateBeforeWall();
  std::vector<DisparityMap> maps = TriangulateViews(views, DelaunayDisparityOptions());
  EXPECT_LT(FreeBesidePlate(maps[0]), 0.1) << "the scene needs bridges";
  ContinueBackground(maps, views, OneRefutes());
  EXPECT_GT(FreeBesidePlate(maps[0]), 0.9);
}

TEST(ContinueBackground, MatterStays)
{
  const std::vector<View> views = PlateBeforeWall();
  std::vector<DisparityMap> maps = TriangulateViews(views, DelaunayDisparityOptions());
  ContinueBackground(maps, views, OneRefutes());
  for (const DisparityMap& map : maps)
  {
    const ViewFreespace freespace(map);
    for (double x = -0.7; x <= 0.7; x += 0.013)
    {
      for (double y = -0.7; y <= 0.7; y += 0.013)
      {
        EXPECT_FALSE(freespace.IsFree({ x, y, WallDepth * 1.002 })) << x << " " << y;
        const bool onPlate = std::max(std::abs(x), std::abs(y)) < PlateHalf - 0.003;
        EXPECT_FALSE(onPlate && freespace.IsFree({ x, y, PlateDepth * 1.002 })) << x << " " << y;
      }
    }
  }
}

// A prism whose right side recedes from (0.2, 1) to (0.4, 1.2), and a wall behind it. The central view
// missed the prism's outer edge: its bridges go from the front's border to the wall, partly through
// the prism. The view from the right saw that edge, and that the wall goes on behind it.
TEST(ContinueBackground, BridgesFromBehindAMissedEdgeStay)
{
  std::vector<View> views = { MakeTurnedView(0, 0), MakeTurnedView(0.6, 0.0) };
  const auto addColumn = [&](std::size_t view, double x, double z)
  {
    for (double y = -0.3; y < 0.31; y += 0.01)
    {
      const Vector3d point(x, y, z);
      views[view].points.push_back(point);
      views[view].imagePoints.push_back(views[view].camera.Project(point));
    }
  };
  addColumn(0, 0.2, 1);
  addColumn(0, 0.75, WallDepth);
  addColumn(0, 0.9, WallDepth);
  addColumn(1, 0.2, 1);
  addColumn(1, 0.3, WallDepth);
  addColumn(1, 0.75, WallDepth);
  const std::vector<View> known = views; // nothing but the free space tells of the outer edge
  addColumn(1, 0.4, 1.2);
  DelaunayDisparityOptions apart;
  apart.minimumDisparity = false;
  std::vector<DisparityMap> maps = TriangulateViews(views, apart);
  const ViewFreespace right(maps[1]);
  EXPECT_TRUE(right.IsFree({ 0.57, 0, 1.67 })) << "the bridge must be seen through further off";
  const std::size_t points = maps[0].points.size();
  ContinueBackground(maps, known, OneRefutes());
  EXPECT_EQ(maps[0].points.size(), points);
  const ViewFreespace central(maps[0]);
  for (double y = -0.2; y < 0.2; y += 0.05)
  {
    EXPECT_FALSE(central.IsFree({ 0.375, y, 1.5 })) << y; // in the prism
  }
}

TEST(ContinueBackground, PointsSetBackAreMarkedAndAtTheirPixels)
{
  const std::vector<View> views = PlateBeforeWall();
  const std::vector<DisparityMap> before = TriangulateViews(views, DelaunayDisparityOptions());
  std::vector<DisparityMap> maps = before;
  ContinueBackground(maps, views, OneRefutes());
  ASSERT_EQ(maps.size(), before.size());
  for (std::size_t v = 0; v < maps.size(); ++v)
  {
    const std::size_t own = before[v].points.size();
    ASSERT_GT(maps[v].points.size(), own);
    ASSERT_EQ(maps[v].triangles.size(), before[v].triangles.size());
    ASSERT_EQ(maps[v].sourceView.size(), maps[v].points.size());
    for (std::size_t i = 0; i < maps[v].points.size(); ++i)
    {
      EXPECT_EQ(maps[v].sourceView[i] == -1, i >= own);
      const Vector2d projection = maps[v].camera.Project(maps[v].points[i]);
      EXPECT_LT((projection - maps[v].imagePoints[i]).norm(), 1e-6);
    }
    for (std::size_t t = 0; t < maps[v].triangles.size(); ++t)
    {
      for (int i = 0; i < 3; ++i) // nothing moves in the image, and only ever back
      {
        const int from = before[v].triangles[t][i], to = maps[v].triangles[t][i];
        EXPECT_EQ(maps[v].imagePoints[to], before[v].imagePoints[from]);
        EXPECT_GE(maps[v].camera.Depth(maps[v].points[to]),
          before[v].camera.Depth(before[v].points[from]) * (1 - 1e-9));
      }
    }
  }
}

TEST(ContinueBackground, WithoutWitnessBridgesStay)
{
  std::vector<View> views = PlateBeforeWall();
  views.resize(1);
  const std::vector<DisparityMap> before = TriangulateViews(views, DelaunayDisparityOptions());
  std::vector<DisparityMap> maps = before;
  ContinueBackground(maps, views, OneRefutes());
  EXPECT_EQ(maps[0].triangles, before[0].triangles);

  views = PlateBeforeWall();
  maps = TriangulateViews(views, DelaunayDisparityOptions());
  const std::vector<DisparityMap> three = maps;
  BackgroundOptions options;
  options.views = 3; // but there are only two others
  ContinueBackground(maps, views, options);
  EXPECT_EQ(maps[0].triangles, three[0].triangles);
}

// A feature of another view under the bridge speaks for matter there.
TEST(ContinueBackground, KnownPointsAreNotFreed)
{
  std::vector<View> views = PlateBeforeWall();
  std::vector<DisparityMap> maps = TriangulateViews(views, DelaunayDisparityOptions());
  const Vector2d pixel = maps[0].camera.Project({ PlateHalf + 0.01, 0.003, PlateDepth });
  const Vector3d post = maps[0].camera.Unproject(pixel, 1.9);
  views[1].points.push_back(post);
  ContinueBackground(maps, views, OneRefutes());
  EXPECT_FALSE(ViewFreespace(maps[0]).IsFree(post));
  EXPECT_GT(FreeBesidePlate(maps[0]), 0.6) << "elsewhere it goes on";
}

TEST(ContinueBackground, NoMapsAndEmptyMaps)
{
  std::vector<DisparityMap> maps;
  ContinueBackground(maps, {}, BackgroundOptions());
  EXPECT_TRUE(maps.empty());
  maps.resize(2);
  maps[0].camera.width = maps[0].camera.height = 10;
  maps[1].camera = maps[0].camera;
  ContinueBackground(maps, std::vector<View>(2), BackgroundOptions());
  EXPECT_EQ(maps.size(), 2u);
}

TEST(ContinueBackground, OptionsOutOfRange)
{
  std::vector<DisparityMap> maps;
  BackgroundOptions options;
  options.noise = 0;
  EXPECT_THROW(ContinueBackground(maps, {}, options), Error);
  options = {};
  options.grazingAngle = 90;
  EXPECT_THROW(ContinueBackground(maps, {}, options), Error);
  options = {};
  options.views = 0;
  EXPECT_THROW(ContinueBackground(maps, {}, options), Error);
  options = {};
  options.edgeWidth = -1;
  EXPECT_THROW(ContinueBackground(maps, {}, options), Error);
}
