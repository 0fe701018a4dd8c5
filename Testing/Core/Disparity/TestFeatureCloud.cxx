// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/FeatureCloud.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <random>
#include <set>

using namespace freespace;

namespace
{

using Key = std::array<double, 3>;

Key KeyOf(const Eigen::Vector3d& point)
{
  return { point.x(), point.y(), point.z() };
}

Camera RandomCamera(std::mt19937& random)
{
  std::normal_distribution<double> normal;
  Camera camera;
  camera.K << 400, 0, 210, 0, 420, 140, 0, 0, 1;
  camera.width = 400;
  camera.height = 300;
  camera.R = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
               .normalized()
               .toRotationMatrix();
  camera.t = { normal(random), normal(random), normal(random) };
  return camera;
}

// Views that share about half of their points.
std::vector<View> MakeViewsOfPoints(int views, int pointsPerView)
{
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<Eigen::Vector3d> common;
  for (int i = 0; i < pointsPerView; ++i)
  {
    common.push_back({ normal(random), normal(random), normal(random) });
  }
  std::vector<View> result(views);
  for (View& view : result)
  {
    for (int i = 0; i < pointsPerView; ++i)
    {
      const Eigen::Vector3d own(normal(random), normal(random), normal(random));
      view.points.push_back(random() % 2 ? own : common[random() % common.size()]);
    }
  }
  return result;
}

}

TEST(FeatureCloud, EveryPointOnceUnderItsFirstView)
{
  const std::vector<View> views = MakeViewsOfPoints(5, 2000);
  std::map<Key, int> expected, found;
  for (std::size_t v = 0; v < views.size(); ++v)
  {
    for (const Eigen::Vector3d& point : views[v].points)
    {
      expected.emplace(KeyOf(point), static_cast<int>(v));
    }
  }
  const FeatureCloud cloud(views);
  EXPECT_EQ(cloud.Size(), expected.size());
  EXPECT_LT(cloud.Size(), 10000u) << "nothing was shared";
  // A camera far away sees all.
  Camera camera;
  camera.K << 1, 0, 200, 0, 1, 200, 0, 0, 1;
  camera.width = camera.height = 400;
  camera.t = { 0, 0, 100 };
  cloud.VisitSeen(camera,
    [&](const FeatureCloud::Feature& feature)
    { EXPECT_TRUE(found.emplace(KeyOf(feature.point), feature.sourceView).second) << "twice"; });
  EXPECT_EQ(found, expected);
}

TEST(FeatureCloud, NothingThatIsSeenIsPassedOver)
{
  const std::vector<View> views = MakeViewsOfPoints(6, 3000);
  const FeatureCloud cloud(views);
  std::mt19937 random(9);
  std::size_t visited = 0;
  for (int trial = 0; trial < 40; ++trial)
  {
    const Camera camera = RandomCamera(random);
    std::map<Key, int> seen;
    cloud.VisitSeen(camera,
      [&](const FeatureCloud::Feature& feature)
      { seen.emplace(KeyOf(feature.point), feature.sourceView); });
    visited += seen.size();
    for (const View& view : views)
    {
      for (const Eigen::Vector3d& point : view.points)
      {
        if (camera.Depth(point) > 0 && camera.Sees(camera.Project(point)))
        {
          EXPECT_TRUE(seen.count(KeyOf(point)));
        }
      }
    }
  }
  EXPECT_LT(visited, 40 * cloud.Size() / 2) << "boxes were not passed over";
}

TEST(FeatureCloud, OfSomeViewsAndWhatIsShared)
{
  const std::vector<View> views = MakeViewsOfPoints(6, 1500);
  std::map<Key, std::set<int>> expected;
  for (std::size_t v = 0; v < views.size(); ++v)
  {
    for (const Eigen::Vector3d& point : views[v].points)
    {
      expected[KeyOf(point)].insert(static_cast<int>(v));
    }
  }
  Camera camera;
  camera.K << 1, 0, 200, 0, 1, 200, 0, 0, 1;
  camera.width = camera.height = 400;
  camera.t = { 0, 0, 100 };
  std::set<Key> found;
  FeatureCloud(views).VisitSeen(camera, { 1, 4 },
    [&](const FeatureCloud::Feature& feature)
    { EXPECT_TRUE(found.insert(KeyOf(feature.point)).second) << "twice"; });
  for (const auto& [point, of] : expected)
  {
    const bool isWanted = of.size() > 1 || of.count(1) > 0 || of.count(4) > 0;
    EXPECT_EQ(found.count(point), isWanted ? 1u : 0u);
  }
}

TEST(FeatureCloud, EmptyOnePointAndNaN)
{
  std::vector<View> views(2);
  EXPECT_EQ(FeatureCloud(views).Size(), 0u);
  EXPECT_EQ(FeatureCloud({}).Size(), 0u);
  views[1].points = { { 0, 0, 1 }, { 0, std::numeric_limits<double>::quiet_NaN(), 1 } };
  EXPECT_EQ(FeatureCloud(views).Size(), 1u);
}

TEST(FeatureCloud, DuplicatePoints)
{
  std::vector<View> views(1);
  views[0].points.assign(5000, { 1, 2, 3 });
  EXPECT_EQ(FeatureCloud(views).Size(), 1u);
}

// Points that differ in one coordinate only cannot be split along the others.
TEST(FeatureCloud, CollinearPoints)
{
  std::vector<View> views(1);
  for (int i = 0; i < 5000; ++i)
  {
    views[0].points.push_back({ 0, 0, 1.0 + i });
  }
  std::size_t visited = 0;
  Camera camera;
  camera.width = camera.height = 1;
  FeatureCloud(views).VisitSeen(camera, [&](const FeatureCloud::Feature&) { ++visited; });
  EXPECT_EQ(visited, 5000u);
}

// What a view visits does not grow with the number of views: twice the flight, the same work per view.
TEST(FeatureCloud, WorkPerViewIsThatOfItsSurroundings)
{
  std::vector<double> visitedPerView;
  for (const int count : { 100, 200, 400 })
  {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-2, 2);
    std::vector<View> views(count);
    for (int v = 0; v < count; ++v)
    {
      views[v].camera.K << 100, 0, 100, 0, 100, 100, 0, 0, 1;
      views[v].camera.width = views[v].camera.height = 200;
      views[v].camera.t = { -1.0 * v, 0, 2 };
      for (int i = 0; i < 1000; ++i)
      {
        views[v].points.push_back({ v + place(random), place(random), 0.1 * place(random) });
      }
    }
    const FeatureCloud cloud(views);
    std::size_t visited = 0;
    for (const View& view : views)
    {
      cloud.VisitSeen(view.camera, [&](const FeatureCloud::Feature&) { ++visited; });
    }
    visitedPerView.push_back(static_cast<double>(visited) / count);
  }
  EXPECT_LT(visitedPerView[1], 1.1 * visitedPerView[0]);
  EXPECT_LT(visitedPerView[2], 1.1 * visitedPerView[0]);
}
