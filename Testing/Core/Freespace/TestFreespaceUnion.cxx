// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/FreespaceUnion.h"

#include "Common/Error.h"
#include "Support/RandomMaps.h"

#include <gtest/gtest.h>

using namespace freespace;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

// What a view says of a point, straight from the definition: the depth at which the ray through the
// point meets the space triangle that its pixel falls into, less the point's depth.
bool BruteForceClaim(const DisparityMap& map, const Vector3d& point, double& value)
{
  if (!(map.camera.Depth(point) > 0))
  {
    return false;
  }
  const Vector3d eye = map.camera.Center(), direction = point - eye;
  for (const auto& t : map.triangles)
  {
    Eigen::Matrix3d m;
    const Vector3d &a = map.points[t[0]], &b = map.points[t[1]], &c = map.points[t[2]];
    m << b - a, c - a, -direction;
    const Vector3d x = m.fullPivLu().solve(eye - a);
    if (x[0] >= 0 && x[1] >= 0 && x[0] + x[1] <= 1 && x[2] > 0)
    {
      value = (x[2] - 1.0) * map.camera.Depth(point);
      return true;
    }
  }
  return false;
}

// Outside of the hull: some plane through three points has all points on one side, and this beyond.
double BruteForceHull(const std::vector<Vector3d>& points, const Vector3d& x)
{
  double greatest = -HUGE_VAL;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    for (std::size_t j = i + 1; j < points.size(); ++j)
    {
      for (std::size_t k = j + 1; k < points.size(); ++k)
      {
        Vector3d n = (points[j] - points[i]).cross(points[k] - points[i]).normalized();
        double low = 0, high = 0;
        for (const Vector3d& p : points)
        {
          low = std::min(low, n.dot(p - points[i]));
          high = std::max(high, n.dot(p - points[i]));
        }
        if (low > -1e-12 || high < 1e-12)
        {
          n = high > 1e-12 ? Vector3d(-n) : n;
          greatest = std::max(greatest, n.dot(x - points[i]));
        }
      }
    }
  }
  return greatest;
}

std::vector<Vector3d> Features(const std::vector<DisparityMap>& maps)
{
  std::vector<Vector3d> all;
  for (const DisparityMap& map : maps)
  {
    all.insert(all.end(), map.points.begin(), map.points.end());
  }
  return all;
}

FreespaceUnionOptions Options(int minimumViews, double hullMargin)
{
  FreespaceUnionOptions options;
  options.minimumViews = minimumViews;
  options.hullMargin = hullMargin;
  return options;
}

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

}

TEST(FeatureHull, AgreesWithBruteForce)
{
  for (int seed = 0; seed < 10; ++seed)
  {
    std::srand(seed);
    std::vector<Vector3d> points(14);
    std::generate(points.begin(), points.end(), [] { return Vector3d::Random(); });
    const FeatureHull hull(points, 0.0);
    for (int i = 0; i < 300; ++i)
    {
      const Vector3d x = 1.2 * Vector3d::Random();
      const double truth = BruteForceHull(points, x);
      const double value = hull.Distance(hull.NearestPlane(x), x);
      if (truth < 0)
      {
        EXPECT_NEAR(value, truth, 1e-9);
      }
      else
      {
        EXPECT_GE(value, truth - 1e-9);
      }
    }
  }
}

TEST(FeatureHull, LeavingOutInnerPointsChangesNothing)
{
  std::srand(3);
  std::vector<Vector3d> points(5000);
  std::generate(points.begin(), points.end(), [] { return Vector3d::Random(); });
  const FeatureHull hull(points, 0.0);
  double touched = -1;
  for (const Vector3d& p : points)
  {
    const double distance = hull.Distance(hull.NearestPlane(p), p);
    EXPECT_LE(distance, 1e-12);
    touched = std::max(touched, distance);
  }
  for (int plane = 0; plane < hull.NumberOfPlanes(); ++plane)
  {
    double nearest = -1;
    for (const Vector3d& p : points)
    {
      nearest = std::max(nearest, hull.Distance(plane, p));
    }
    EXPECT_NEAR(nearest, 0.0, 1e-12);
  }
  EXPECT_NEAR(touched, 0.0, 1e-12);
}

TEST(FeatureHull, TheNearestPlaneIsTheNearestOfAll)
{
  std::srand(4);
  std::vector<Vector3d> points(3000);
  for (Vector3d& p : points)
  {
    // A box with noise, as of a board: facets by the hundred, nearly parallel.
    p = Vector3d::Random();
    p[std::rand() % 3] = (std::rand() % 2 ? 1.0 : -1.0) + 1e-3 * Vector3d::Random().x();
  }
  const FeatureHull hull(points, 0.02);
  EXPECT_GT(hull.NumberOfPlanes(), 100);
  for (int i = 0; i < 20000; ++i)
  {
    const Vector3d x = (i % 2 ? 1.03 : 1.5) * Vector3d::Random();
    EXPECT_NEAR(
      hull.Distance(hull.NearestPlane(x), x), hull.Distance(hull.NearestOfAll(x), x), 1e-9);
  }
}

TEST(FeatureHull, WithoutVolumeTheMarginGivesOne)
{
  const Vector3d o(1, 2, 3), u(1, 0.5, 0), v(0, 1, 1);
  for (const std::vector<Vector3d>& points :
    { std::vector<Vector3d>{ o }, std::vector<Vector3d>{ o, o + u },
      std::vector<Vector3d>{ o, o + u, o + 2 * u }, std::vector<Vector3d>{ o, o + u, o + v },
      std::vector<Vector3d>{ o, o + u, o + v, o + u + v },
      std::vector<Vector3d>{ o, o, o, Vector3d(NAN, 0, 0) } })
  {
    const FeatureHull thick(points, 0.1), thin(points, 0.0);
    for (const Vector3d& p : points)
    {
      if (p.allFinite())
      {
        EXPECT_NEAR(thick.Distance(thick.NearestPlane(p), p), -0.1, 1e-9);
        EXPECT_NEAR(thin.Distance(thin.NearestPlane(p), p), 0.0, 1e-9);
      }
    }
    const Vector3d away = thick.Bounds().max() + Vector3d::Constant(1e-6);
    EXPECT_GT(thick.Distance(thick.NearestPlane(away), away), 0);
    EXPECT_LT(thick.Bounds().diagonal().norm(), 5);
  }
  EXPECT_TRUE(FeatureHull({}, 0.1).IsEmpty());
  EXPECT_TRUE(FeatureHull({ Vector3d(NAN, 0, 0) }, 0.1).IsEmpty());
}

TEST(FreespaceUnion, AgreesWithBruteForce)
{
  for (unsigned int seed = 0; seed < 25; ++seed)
  {
    const std::vector<DisparityMap> maps = RandomMaps(seed, 1 + seed % 4);
    const std::vector<Vector3d> features = Features(maps);
    const int k = 1 + seed % 2;
    const FreespaceUnion phi(maps, Options(k, 0.0));
    int claimed = 0;
    for (int i = 0; i < 400; ++i)
    {
      const Vector3d x = 1.6 * Vector3d::Random();
      std::vector<double> claims;
      for (const DisparityMap& map : maps)
      {
        double value;
        if (BruteForceClaim(map, x, value))
        {
          claims.push_back(value);
        }
      }
      claimed += !claims.empty();
      std::sort(claims.rbegin(), claims.rend());
      const double hull = phi.Hull().Distance(phi.Hull().NearestPlane(x), x);
      const double truth =
        static_cast<int>(claims.size()) < k ? hull : std::max(hull, claims[k - 1]);
      EXPECT_NEAR(phi.Value(x), truth, 1e-9) << "seed " << seed;
      EXPECT_EQ(phi.IsFree(x), phi.Value(x) > 0);
      EXPECT_EQ(phi.IsFree(x, phi.Root()), phi.Value(x) > 0);
    }
    EXPECT_GT(claimed, 100);
  }
}

TEST(FreespaceUnion, GradientIsTheSlopeOfTheValue)
{
  const FreespaceUnion phi(RandomMaps(7, 3), Options(1, 0.01));
  int tried = 0;
  for (int i = 0; i < 300; ++i)
  {
    const Vector3d x = 1.2 * Vector3d::Random();
    Vector3d slope;
    const double h = 1e-6;
    bool kink = false;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vector3d step = h * Vector3d::Unit(axis);
      const double ahead = phi.Value(x + step), here = phi.Value(x), behind = phi.Value(x - step);
      slope[axis] = (ahead - behind) / (2 * h);
      kink = kink || std::abs(ahead + behind - 2 * here) > 1e-9;
    }
    if (!kink)
    {
      ++tried;
      EXPECT_LT((phi.Gradient(x) - slope).norm(), 1e-4 * (1 + slope.norm()));
    }
  }
  EXPECT_GT(tried, 200);
}

TEST(FreespaceUnion, BoxesAgreeWithTheirPoints)
{
  int decided = 0;
  for (unsigned int seed = 100; seed < 140; ++seed)
  {
    const FreespaceUnion phi(RandomMaps(seed, 1 + seed % 4), Options(1 + seed % 2, 0.01));
    for (int i = 0; i < 100; ++i)
    {
      const Vector3d center = 1.5 * Vector3d::Random();
      const Vector3d half = (0.3 / (1 + i % 10)) * Vector3d(1, 0.5, 0.7);
      const Eigen::AlignedBox3d outer(center - half, center + half);
      FieldScope scope, inner;
      const BoxContent content = phi.Classify(outer, phi.Root(), scope);
      // A part of the box, asked within the scope of the whole.
      const Eigen::AlignedBox3d part(center - 0.5 * half, center + 0.3 * half);
      const BoxContent partContent =
        content == BoxContent::Mixed ? phi.Classify(part, scope, inner) : content;
      decided += partContent != BoxContent::Mixed;
      for (int j = 0; j < 50; ++j)
      {
        const Vector3d x = outer.sample(), y = part.sample();
        if (content == BoxContent::Mixed)
        {
          ASSERT_EQ(phi.IsFree(x, scope), phi.IsFree(x));
        }
        else
        {
          ASSERT_EQ(phi.IsFree(x), content == BoxContent::Free);
        }
        if (partContent != BoxContent::Mixed)
        {
          ASSERT_EQ(phi.IsFree(y), partContent == BoxContent::Free);
        }
        else
        {
          ASSERT_EQ(phi.IsFree(y, inner), phi.IsFree(y));
        }
      }
    }
  }
  EXPECT_GT(decided, 800);
}

// From the matter's end of a segment all is matter up to the crossing, and just beyond it is free.
TEST(FreespaceUnion, CrossingsAreTheFirstPlacesThatEnoughViewsSeeFree)
{
  int found = 0, byHull = 0;
  for (unsigned int seed = 0; seed < 40; ++seed)
  {
    const int views = 1 + seed % 6, minimumViews = 1 + seed / 6 % std::min(views, 4);
    const FreespaceUnion phi(RandomMaps(seed, views), Options(minimumViews, seed % 2 ? 0.1 : 0.0));
    const FieldScope scope = phi.Root();
    const Eigen::AlignedBox3d box = phi.Hull().Bounds();
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const auto place = [&]
    {
      const Vector3d share(uniform(random), uniform(random), uniform(random));
      return Vector3d(box.min() + share.cwiseProduct(box.sizes()));
    };
    for (int i = 0; i < 300; ++i)
    {
      const Vector3d matter = place(), free = matter + (i % 2 ? 1.0 : 0.05) * (place() - matter);
      double crossing;
      SurfaceLabel label;
      if (phi.IsFree(matter) || !phi.IsFree(free))
      {
        continue;
      }
      const auto at = [&](double s) { return Vector3d(matter + s * (free - matter)); };
      ASSERT_TRUE(phi.Crossing(matter, free, scope, crossing, label));
      ++found;
      byHull += label.view < 0;
      EXPECT_FALSE(phi.IsFree(at(crossing - 1e-7))) << seed << " " << i;
      EXPECT_TRUE(phi.IsFree(at(std::min(1.0, crossing + 1e-7)))) << seed << " " << i;
      for (int j = 0; j < 200; ++j)
      {
        ASSERT_FALSE(phi.IsFree(at((crossing - 1e-7) * j / 200))) << seed << " " << i;
      }
    }
  }
  EXPECT_GT(found, 1000);
  EXPECT_LT(byHull, found / 2);
}

TEST(ViewFreespace, IntervalsOfSegmentsAgreeWithTheirPoints)
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

namespace
{

// A map of so many triangles that the way over it is taken block by block: hills, a step and holes.
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

TEST(ViewFreespace, LongSegmentsOverAFineMapAgreeWithTheirPoints)
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

TEST(ViewFreespace, AVisitorOfIntervalsMayStop)
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

TEST(ViewFreespace, ATriangleSeenEdgeOnIsAJump)
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

TEST(FreespaceUnion, AwkwardInput)
{
  const FreespaceUnion empty({}, {});
  EXPECT_TRUE(empty.IsFree(Vector3d::Zero()));
  EXPECT_EQ(empty.Value(Vector3d::Zero()), HUGE_VAL);

  DisparityMap map = RandomMaps(1, 1)[0];
  const Vector3d behind = map.camera.Center() + 2 * (map.camera.Center() - map.points[0]);
  map.points.push_back({ NAN, 0, 0 });
  map.imagePoints.push_back({ 50, 40 });
  map.points.push_back(behind);
  map.imagePoints.push_back({ 50, 40 });
  const int nan = static_cast<int>(map.points.size()) - 2;
  const std::size_t sound = map.triangles.size();
  map.triangles.push_back({ 0, 1, nan });     // not a number
  map.triangles.push_back({ 0, 1, nan + 1 }); // behind the camera
  map.triangles.push_back({ 0, 1, 1 });       // without area
  const FreespaceUnion phi({ map }, {});
  EXPECT_EQ(phi.ViewAt(0).NumberOfTriangles(), sound);
  EXPECT_TRUE(phi.IsFree(Vector3d(NAN, 0, 0)));
  EXPECT_EQ(phi.Value(Vector3d(NAN, 0, 0)), HUGE_VAL);
  EXPECT_FALSE(phi.ViewAt(0).IsFree(map.camera.Center()));

  map.triangles.push_back({ 0, 1, 9999 });
  EXPECT_THROW(FreespaceUnion({ map }, {}), Error);
  EXPECT_THROW(FreespaceUnion({}, Options(0, 0.01)), Error);
  EXPECT_THROW(FreespaceUnion({}, Options(1, -0.01)), Error);
  EXPECT_THROW(FreespaceUnion({}, Options(1, NAN)), Error);
  EXPECT_THROW(FreespaceUnion({}, Options(1, HUGE_VAL)), Error);
  EXPECT_THROW(FreespaceUnion({}, Options(1, 10.0)), Error);
  EXPECT_NO_THROW(FreespaceUnion({}, Options(1, 9.9)));
  const std::vector<DisparityMap> two = RandomMaps(3, 2);
  EXPECT_NO_THROW(FreespaceUnion(two, Options(2, 0.01)));
  EXPECT_THROW(FreespaceUnion(two, Options(3, 0.01)), Error);
}

TEST(FreespaceUnion, StopsWhereverItIsBuilt)
{
  const std::vector<DisparityMap> maps = RandomMaps(3, 8);
  int events = 0;
  double last = 0.0;
  const auto build = [&](int stopAt)
  {
    events = 0;
    last = 0.0;
    return FreespaceUnion(maps, Options(1, 0.01), SerialFor,
      Progress(
        [&](double fraction)
        {
          EXPECT_GE(fraction, last);
          last = fraction;
          return ++events != stopAt;
        }));
  };
  build(0);
  EXPECT_EQ(last, 1.0);
  for (int stopAt = 1; stopAt <= 4; ++stopAt)
  {
    EXPECT_THROW(build(stopAt), Aborted);
    EXPECT_EQ(events, stopAt);
  }
  CancellationFlag stop(true);
  EXPECT_THROW(ViewFreespace(maps[0], stop), Aborted);
  EXPECT_THROW(FeatureHull(maps[0].points, 0.0, stop), Aborted);
}

TEST(FreespaceUnion, AStoppedIndexIsMadeAnew)
{
  const FreespaceUnion phi(RandomMaps(3, 20), Options(1, 0.01));
  int events = 0;
  const Progress third([&](double) { return ++events != 3; });
  EXPECT_THROW(phi.IndexForPoints(third), Aborted);
  EXPECT_EQ(events, 3);
  double last = 0.0;
  const Progress whole(
    [&](double fraction)
    {
      EXPECT_GE(fraction, last);
      last = fraction;
      return true;
    });
  phi.IndexForPoints(whole);
  EXPECT_EQ(last, 1.0);
  EXPECT_TRUE(phi.IsFree(Vector3d::Constant(50)));
}
