// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/ViewOctree.h"

#include "Freespace/FreespaceUnion.h"
#include "Support/PlainSettings.h"
#include "Support/RandomMaps.h"

#include <gtest/gtest.h>

using namespace freespace;
using Eigen::AlignedBox3d;
using Eigen::Vector3d;

namespace
{

FreespaceUnion MakeOctreeUnion(unsigned int seed, int views, int minimumViews)
{
  auto options = Plain(FreespaceUnionOptions());
  options.minimumViews = minimumViews;
  return FreespaceUnion(RandomMaps(seed, views), options);
}

// Random points in and around the bounds, and points on the planes at which the index divides them.
std::vector<Vector3d> Points(const AlignedBox3d& bounds)
{
  std::vector<Vector3d> points;
  for (int i = 0; i < 1500; ++i)
  {
    points.push_back(bounds.center() + 0.7 * bounds.sizes().cwiseProduct(Vector3d::Random()));
  }
  for (int i = 0; i < 729; ++i)
  {
    const Vector3d eighth(i % 9, i / 9 % 9, i / 81);
    points.push_back(bounds.min() + eighth.cwiseProduct(bounds.sizes()) / 8);
  }
  return points;
}

// A view straight down on a tile of a plain, beside others like it.
DisparityMap Tile(int column, int row)
{
  DisparityMap map;
  map.camera = LookingAt(Vector3d(column, row, 1), Vector3d(column, row, 0));
  for (const Eigen::Vector2d& pixel : { Eigen::Vector2d(0, 0), Eigen::Vector2d(100, 0),
         Eigen::Vector2d(100, 80), Eigen::Vector2d(0, 80) })
  {
    map.imagePoints.push_back(pixel);
    map.points.push_back(map.camera.Unproject(pixel, 1));
    map.sourceView.push_back(10 * row + column);
  }
  map.triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  return map;
}

}

TEST(ViewOctree, AgreesWithAskingEveryView)
{
  int free = 0, matter = 0;
  for (unsigned int seed = 0; seed < 12; ++seed)
  {
    std::srand(seed);
    const int views = seed % 3 == 0 ? 2 : 25, k = 1 + static_cast<int>(seed % 2);
    const FreespaceUnion phi = MakeOctreeUnion(seed, views, k);
    for (const Vector3d& point : Points(phi.Hull().Bounds()))
    {
      int count = 0;
      std::vector<double> values;
      for (std::size_t v = 0; v < phi.NumberOfViews(); ++v)
      {
        count += phi.ViewAt(v).IsFree(point);
        const ViewFreespace::Sample sample = phi.ViewAt(v).At(point);
        if (sample.triangle >= 0)
        {
          values.push_back(sample.value);
        }
      }
      ASSERT_EQ(phi.IsSeenFree(point), count >= k);
      const double hull = phi.Hull().Distance(phi.Hull().NearestPlane(point), point);
      ASSERT_EQ(phi.IsFree(point), count >= k || hull > 0);
      std::sort(values.rbegin(), values.rend());
      const double seen = static_cast<int>(values.size()) >= k ? values[k - 1] : -HUGE_VAL;
      ASSERT_EQ(phi.Value(point), std::max(hull, seen));
      (phi.IsFree(point) ? free : matter) += 1;
    }
  }
  EXPECT_GT(free, 5000);
  EXPECT_GT(matter, 2000);
}

TEST(ViewOctree, AScopeAroundABoxDecidesItsPointsAsTheRootDoes)
{
  for (unsigned int seed = 0; seed < 10; ++seed)
  {
    std::srand(seed);
    const FreespaceUnion phi = MakeOctreeUnion(seed, 12, 1 + static_cast<int>(seed % 2));
    const AlignedBox3d& bounds = phi.Hull().Bounds();
    for (int i = 0; i < 100; ++i)
    {
      const Vector3d low = bounds.sample();
      const AlignedBox3d box(low, low + 0.1 * (i % 4) * bounds.sizes());
      const FieldScope scope = phi.ScopeAround(box);
      for (int j = 0; j < 20; ++j)
      {
        const Vector3d point = box.sample();
        ASSERT_EQ(phi.IsFree(point, scope), phi.IsFree(point, phi.Root()));
      }
    }
  }
}

// The cost of a query does not grow with the views that look elsewhere.
TEST(ViewOctree, OfManyViewsOfAPlainFewAreAsked)
{
  std::vector<std::unique_ptr<ViewFreespace>> views;
  for (int i = 0; i < 400; ++i)
  {
    views.push_back(std::make_unique<ViewFreespace>(Tile(i % 20, i / 20)));
  }
  const AlignedBox3d box(Vector3d(0, 0, -0.1), Vector3d(19, 19, 0.3));
  const ViewOctree index(
    views.size(), box,
    [&views](std::size_t view, const AlignedBox3d& part) { return VoteOn(*views[view], part, 0); },
    1, 7);
  std::srand(1);
  std::ptrdiff_t most = 0;
  for (int i = 0; i < 2000; ++i)
  {
    const ViewOctree::Part part = index.At(box.sample());
    most = std::max(most, part.end - part.begin);
  }
  EXPECT_LE(most, 4);
  EXPECT_LT(index.NumberOfParts(), 131072u + 8);
}

TEST(ViewOctree, NoViews)
{
  const ViewOctree index(
    0, AlignedBox3d(Vector3d::Zero(), Vector3d::Ones()),
    [](std::size_t, const AlignedBox3d&) { return Vote::Undecided; }, 1, 7);
  const ViewOctree::Part part = index.At(Vector3d::Constant(0.3));
  EXPECT_EQ(part.begin, part.end);
  EXPECT_EQ(part.votes.free, 0);
  EXPECT_EQ(part.votes.against, 0);
}
