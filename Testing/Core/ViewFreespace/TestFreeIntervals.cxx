// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFreespace/ViewFreespace.h"

#include "Freespace/FreespaceUnion.h"
#include "Support/RandomMaps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

using namespace freespace;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

// Asks the view at places of a segment, but for those where an interval begins or ends.
void ExpectFreeWithin(const ViewFreespace::Intervals& intervals, const ViewFreespace& view,
  const Vector3d& first, const Vector3d& last, int places)
{
  for (int j = 0; j <= places; ++j)
  {
    const double s = j / static_cast<double>(places);
    bool inside = false, close = false;
    for (const auto& [begin, end] : intervals)
    {
      inside = inside || (s >= begin && s <= end);
      close = close || std::abs(s - begin) < 1e-7 || std::abs(s - end) < 1e-7;
    }
    if (!close)
    {
      ASSERT_EQ(view.IsFree(first + s * (last - first)), inside) << "at " << s;
    }
  }
}

// A map of so many triangles that the way over it is taken tile by tile: hills, a step and holes.
DisparityMap FineMap(unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  DisparityMap map;
  map.camera = LookingAt({ 0, 0, -3 }, { 0.1 * uniform(random), 0, 0 });
  constexpr int n = 60;
  const double step = 20 + 60 * uniform(random);
  for (int i = 0; i <= n; ++i)
  {
    for (int j = 0; j <= n; ++j)
    {
      const Vector2d pixel(
        5 + 90.0 * (j + 0.6 * uniform(random)) / n, 5 + 70.0 * (i + 0.6 * uniform(random)) / n);
      const double hills = 0.4 * std::sin(0.11 * pixel.x()) * std::cos(0.13 * pixel.y());
      map.imagePoints.push_back(pixel);
      map.points.push_back(map.camera.Unproject(pixel, 3 + hills + (pixel.x() > step ? 0.8 : 0.0)));
      map.sourceView.push_back(0);
    }
  }
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < n; ++j)
    {
      const int a = i * (n + 1) + j, b = a + 1, c = a + n + 1, d = c + 1;
      if (uniform(random) > 0.003)
      {
        map.triangles.push_back({ a, b, d });
        map.triangles.push_back({ a, d, c });
      }
    }
  }
  return map;
}

}

TEST(FreeIntervals, IntervalsOfSegmentsAgreeWithTheirPoints)
{
  for (unsigned int seed = 0; seed < 30; ++seed)
  {
    const ViewFreespace view(RandomMaps(seed, 1)[0]);
    ViewFreespace::Intervals intervals;
    std::size_t total = 0;
    for (int i = 0; i < 60; ++i)
    {
      // Short ones and long ones, some from behind the camera.
      const double length = i % 3 == 0 ? 0.05 : i % 3 == 1 ? 1.0 : 8.0;
      const Vector3d first = 1.5 * Vector3d::Random();
      const Vector3d last = first + length * Vector3d::Random();
      view.FreeIntervals(first, last, intervals);
      total += intervals.size();
      ASSERT_NO_FATAL_FAILURE(ExpectFreeWithin(intervals, view, first, last, 200)) << seed;
    }
    EXPECT_GT(total, 10u);
  }
}

TEST(FreeIntervals, LongSegmentsOverAFineMapAgreeWithTheirPoints)
{
  std::size_t total = 0;
  for (unsigned int seed = 0; seed < 10; ++seed)
  {
    std::srand(seed);
    const ViewFreespace view(FineMap(seed));
    ViewFreespace::Intervals intervals;
    for (int i = 0; i < 100; ++i)
    {
      const double depth = i % 4 == 0 ? 0.0 : 0.7;
      const Vector3d first = Vector3d::Random().cwiseProduct(Vector3d(2, 2, depth));
      const Vector3d last = Vector3d::Random().cwiseProduct(Vector3d(2, 2, 0.7));
      view.FreeIntervals(first, last, intervals);
      total += intervals.size();
      for (std::size_t k = 0; k < intervals.size(); ++k)
      {
        ASSERT_LE(intervals[k].first, intervals[k].second);
        ASSERT_TRUE(k == 0 || intervals[k].first > intervals[k - 1].second);
      }
      ASSERT_NO_FATAL_FAILURE(ExpectFreeWithin(intervals, view, first, last, 500)) << seed;
    }
  }
  EXPECT_GT(total, 1000u);
}

TEST(FreeIntervals, AVisitorOfIntervalsMayStop)
{
  const ViewFreespace view(FineMap(1));
  std::srand(1);
  ViewFreespace::Intervals all;
  int several = 0;
  for (int i = 0; i < 200; ++i)
  {
    const Vector3d first = Vector3d::Random().cwiseProduct(Vector3d(2, 2, 0.7));
    const Vector3d last = Vector3d::Random().cwiseProduct(Vector3d(2, 2, 0.7));
    view.FreeIntervals(first, last, all);
    several += all.size() > 1;
    for (std::size_t enough = 1; enough <= all.size(); ++enough)
    {
      ViewFreespace::Intervals seen;
      view.VisitFreeIntervals(first, last,
        [&](double begin, double end)
        {
          seen.emplace_back(begin, end);
          return seen.size() < enough;
        });
      ASSERT_EQ(seen, ViewFreespace::Intervals(all.begin(), all.begin() + enough));
    }
  }
  EXPECT_GT(several, 20);
}

TEST(FreeIntervals, ATriangleSeenEdgeOnIsAJump)
{
  // Two steps of a stair and the riser between them, which the view sees but for a hair edge-on.
  DisparityMap map;
  map.camera = LookingAt({ 0, 0, 0 }, { 0, 0, 1 });
  for (double x : { 30.0, 50.0, 50.2, 70.0 })
  {
    for (double y : { 20.0, 60.0 })
    {
      map.imagePoints.push_back({ x, y });
      map.points.push_back(map.camera.Unproject({ x, y }, x <= 50 ? 2.0 : 3.0));
    }
  }
  for (int i : { 0, 2, 4 })
  {
    map.triangles.push_back({ i, i + 2, i + 1 });
    map.triangles.push_back({ i + 2, i + 3, i + 1 });
  }
  const FreespaceUnion phi({ map }, {});
  const auto label = [&](const Vector2d& pixel, double depth)
  {
    SurfaceLabel found;
    double place;
    const Vector3d matter = map.camera.Unproject(pixel, depth + 0.1);
    const Vector3d free = map.camera.Unproject(pixel, depth - 0.1);
    EXPECT_TRUE(phi.Crossing(matter, free, phi.Root(), place, found));
    EXPECT_NEAR(place, 0.5, 1e-9);
    EXPECT_EQ(
      phi.Label(matter + 0.501 * (free - matter), matter + 0.499 * (free - matter), phi.Root())
        .kind,
      found.kind);
    return found.kind;
  };
  EXPECT_EQ(label({ 40, 40 }, 2.0), SurfaceKind::Feature);
  EXPECT_EQ(label({ 60, 40 }, 3.0), SurfaceKind::Feature);
  EXPECT_EQ(label({ 50.1, 40 }, 2.4), SurfaceKind::Wall);
}
