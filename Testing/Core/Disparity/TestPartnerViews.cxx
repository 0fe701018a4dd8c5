// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/PartnerViews.h"

#include "Common/Error.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <limits>
#include <set>

using namespace freespace;

namespace
{

// Views on a ring that look at its middle.
std::vector<View> Ring(int count)
{
  std::vector<View> views(static_cast<std::size_t>(count));
  for (int v = 0; v < count; ++v)
  {
    View& view = views[static_cast<std::size_t>(v)];
    view.camera.R =
      Eigen::AngleAxisd(2 * 3.14159265358979 * v / count, Eigen::Vector3d::UnitY()).matrix();
    view.camera.t = { 0, 0, 5 };
    view.points = { { 0.1, 0, 0 }, { -0.1, 0, 0 }, { 0, 0.1, 0 } };
  }
  return views;
}

PartnerViewsOptions Most(int most)
{
  PartnerViewsOptions options;
  options.most = most;
  return options;
}

}

TEST(PartnerViews, AllWhereTheyAreFew)
{
  for (const int most : { 0, 6, 7 })
  {
    const auto partners = PartnerViews(Ring(7), Most(most));
    ASSERT_EQ(partners.size(), 7u);
    EXPECT_EQ(partners[2], (std::vector<int>{ 0, 1, 3, 4, 5, 6 }));
  }
  EXPECT_TRUE(PartnerViews(std::vector<View>(), Most(3)).empty());
  EXPECT_TRUE(PartnerViews(Ring(1), Most(3))[0].empty());
}

TEST(PartnerViews, TheNextOnesAndSomeOfAllAround)
{
  constexpr int count = 200;
  for (const int most : { 1, 2, 3, 24, 199 })
  {
    const auto partners = PartnerViews(Ring(count), Most(most));
    for (int v = 0; v < count; ++v)
    {
      const std::vector<int>& others = partners[static_cast<std::size_t>(v)];
      EXPECT_EQ(others.size(), static_cast<std::size_t>(most));
      EXPECT_TRUE(std::is_sorted(others.begin(), others.end()));
      EXPECT_EQ(std::set<int>(others.begin(), others.end()).size(), others.size());
      EXPECT_FALSE(std::binary_search(others.begin(), others.end(), v));
    }
  }
  const std::vector<int> of100 = PartnerViews(Ring(count), Most(24))[100];
  for (int v = 94; v <= 106; ++v)
  {
    EXPECT_EQ(std::binary_search(of100.begin(), of100.end(), v), v != 100) << v;
  }
  EXPECT_TRUE(of100.front() < 40 || of100.back() > 160) << "none from the other side";
}

// Cameras at one place that look elsewhere are not next to each other.
TEST(PartnerViews, LookAtTheSamePlace)
{
  std::vector<View> views(40);
  for (std::size_t v = 0; v < views.size(); ++v)
  {
    views[v].camera.t = { 0.001 * static_cast<double>(v), 0, 0 };
    views[v].points = { { v % 2 ? 10.0 : -10.0, 0, 10 } };
  }
  const auto partners = PartnerViews(views, Most(8));
  int same = 0;
  for (const int other : partners[20])
  {
    same += other % 2 == 0;
  }
  EXPECT_GE(same, 6);
}

TEST(PartnerViews, ViewsWithoutFiniteFeatures)
{
  std::vector<View> views = Ring(30);
  views[3].points.clear();
  views[4].points = { { std::numeric_limits<double>::quiet_NaN(), 0, 0 } };
  for (const std::vector<int>& others : PartnerViews(views, Most(5)))
  {
    EXPECT_EQ(others.size(), 5u);
  }
  EXPECT_THROW(PartnerViews(views, Most(-1)), Error);
}
