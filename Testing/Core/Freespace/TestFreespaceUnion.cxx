// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/FreespaceUnion.h"

#include "Common/Error.h"
#include "Support/PlainSettings.h"
#include "Support/RandomMaps.h"

#include <gtest/gtest.h>

using namespace freespace;
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

std::vector<Vector3d> Features(const std::vector<DisparityMap>& maps)
{
  std::vector<Vector3d> all;
  for (const DisparityMap& map : maps)
  {
    all.insert(all.end(), map.points.begin(), map.points.end());
  }
  return all;
}

FreespaceUnionOptions VoteOptions(int minimumViews, double hullMargin)
{
  auto options = Plain(FreespaceUnionOptions());
  options.minimumViews = minimumViews;
  options.hullMargin = hullMargin;
  return options;
}

}

TEST(FreespaceUnion, AgreesWithBruteForce)
{
  for (unsigned int seed = 0; seed < 25; ++seed)
  {
    const std::vector<DisparityMap> maps = RandomMaps(seed, 1 + seed % 4);
    const std::vector<Vector3d> features = Features(maps);
    const int k = 1 + seed % 2;
    const FreespaceUnion phi(maps, VoteOptions(k, 0.0));
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
  const FreespaceUnion phi(RandomMaps(7, 3), VoteOptions(1, 0.01));
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
    const FreespaceUnion phi(RandomMaps(seed, 1 + seed % 4), VoteOptions(1 + seed % 2, 0.01));
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
    const FreespaceUnion phi(
      RandomMaps(seed, views), VoteOptions(minimumViews, seed % 2 ? 0.1 : 0.0));
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
  EXPECT_THROW(FreespaceUnion({}, VoteOptions(0, 0.01)), Error);
  EXPECT_THROW(FreespaceUnion({}, VoteOptions(1, -0.01)), Error);
  EXPECT_THROW(FreespaceUnion({}, VoteOptions(1, NAN)), Error);
  EXPECT_THROW(FreespaceUnion({}, VoteOptions(1, HUGE_VAL)), Error);
  EXPECT_THROW(FreespaceUnion({}, VoteOptions(1, 10.0)), Error);
  EXPECT_NO_THROW(FreespaceUnion({}, VoteOptions(1, 9.9)));
  const std::vector<DisparityMap> two = RandomMaps(3, 2);
  EXPECT_NO_THROW(FreespaceUnion(two, VoteOptions(2, 0.01)));
  EXPECT_THROW(FreespaceUnion(two, VoteOptions(3, 0.01)), Error);
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
    return FreespaceUnion(maps, VoteOptions(1, 0.01), SerialFor,
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
  const FreespaceUnion phi(RandomMaps(3, 20), VoteOptions(1, 0.01));
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

// Without matched edges the far rim of a body is beyond the features: where these are sparse, the automatic hull leaves
// room for it, and everywhere what a lattice needs.
TEST(FreespaceUnion, TheAutomaticMarginFollowsTheCoarserOfLatticeAndFeatures)
{
  FreespaceUnionOptions options;
  EXPECT_EQ(options.MarginFor(256, 400), 1.25 / 256);
  EXPECT_EQ(options.MarginFor(256, 100), 1.25 / 100);
  EXPECT_EQ(options.MarginFor(256, 10), 1.25 / 64); // three features must not inflate the hull
  EXPECT_EQ(options.MarginFor(20, 10), 1.25 / 20);
  EXPECT_EQ(FreespaceUnionOptions::MarginOfLattice(0), FreespaceUnionOptions::AutomaticMargin);
  EXPECT_EQ(FreespaceUnionOptions::MarginOfLattice(512), FreespaceUnionOptions::AutomaticMargin);
  EXPECT_EQ(FreespaceUnionOptions::MarginOfLattice(50), 1.25 / 50);
  options.hullMargin = 0.3;
  EXPECT_EQ(options.MarginFor(256, 100), 0.3);
  options.hullMarginFewest = 0;
  EXPECT_THROW(options.Check(), Error);
}

TEST(FreespaceUnion, TheHullIsMovedByTheAutomaticMargin)
{
  const std::vector<DisparityMap> maps = RandomMaps(11, 3);
  for (const int fewest : { 1, 64 })
  {
    FreespaceUnionOptions options;
    options.hullMarginFewest = fewest;
    const FreespaceUnion automatic(maps, options);
    options.hullMargin = 0;
    const FreespaceUnion paper(maps, options);
    const Eigen::AlignedBox3d& box = paper.FeatureRegion().box;
    const double asked = box.sizes().maxCoeff() / paper.CellSide() * options.resolution.cell;
    ASSERT_LT(asked, 64);
    const double length = 1.25 / std::max<double>(asked, fewest) * box.diagonal().norm();
    for (int i = 0; i < 100; ++i)
    {
      const Vector3d x = 0.5 * Vector3d::Random();
      const int plane = paper.Hull().NearestPlane(x);
      EXPECT_NEAR(
        automatic.Hull().Distance(plane, x), paper.Hull().Distance(plane, x) - length, 1e-9);
    }
  }
}
