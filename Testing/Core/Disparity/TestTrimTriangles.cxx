// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/TrimTriangles.h"

#include "Common/Error.h"
#include "Support/FeatureViews.h"
#include "Support/RandomMaps.h"

#include <gtest/gtest.h>

#include <limits>

using namespace freespace;

namespace
{

// Two triangles on the image square of side 30: one at depth 2, the other with its last corner at depth 3.
DisparityMap TwoTriangles()
{
  DisparityMap map;
  static_cast<View&>(map) = MakeView();
  AddFeature(map, Eigen::Vector2d(500, 500), 2);
  AddFeature(map, Eigen::Vector2d(530, 500), 2);
  AddFeature(map, Eigen::Vector2d(500, 530), 2);
  AddFeature(map, Eigen::Vector2d(530, 530), 3);
  map.triangles = { { 0, 1, 2 }, { 1, 3, 2 } };
  return map;
}

using Triangles = std::vector<std::array<int, 3>>;

Triangles Left(double longestEdge, double greatestDepth)
{
  DisparityMap map = TwoTriangles();
  TrimOptions options;
  options.longestEdge = longestEdge;
  options.greatestDepth = greatestDepth;
  TrimTriangles(map, options);
  EXPECT_EQ(map.points.size(), 4u) << "points stay";
  return map.triangles;
}

}

TEST(TrimTriangles, ByTheLongestEdgeInTheImage)
{
  const double diagonal = 30 * std::sqrt(2.0);
  EXPECT_EQ(Left(diagonal + 0.001, 0).size(), 2u);
  EXPECT_EQ(Left(diagonal - 0.001, 0).size(), 0u) << "both have the diagonal";
}

TEST(TrimTriangles, ByTheRatioOfDepths)
{
  EXPECT_EQ(Left(0, 1.501).size(), 2u);
  EXPECT_EQ(Left(0, 1.499), (Triangles{ { 0, 1, 2 } }));
}

TEST(TrimTriangles, NoLimitIsThePaper)
{
  EXPECT_EQ(Left(0, 0).size(), 2u);
}

TEST(TrimTriangles, KeepsTheOthersInTheirOrder)
{
  std::mt19937 random(5);
  for (int trial = 0; trial < 20; ++trial)
  {
    DisparityMap map = RandomMap(random, 0);
    TrimOptions options;
    options.longestEdge = 30;
    options.greatestDepth = 1.1;
    Triangles expected;
    for (const auto& t : map.triangles)
    {
      double longest = 0, nearest = 1e9, farthest = 0;
      for (int i = 0; i < 3; ++i)
      {
        longest =
          std::max(longest, (map.imagePoints[t[i]] - map.imagePoints[t[(i + 1) % 3]]).norm());
        nearest = std::min(nearest, map.camera.Depth(map.points[t[i]]));
        farthest = std::max(farthest, map.camera.Depth(map.points[t[i]]));
      }
      if (longest <= 30 && farthest <= 1.1 * nearest)
      {
        expected.push_back(t);
      }
    }
    TrimTriangles(map, options);
    EXPECT_EQ(map.triangles, expected);
  }
}

TEST(TrimTriangles, OptionsOutOfRange)
{
  DisparityMap map = TwoTriangles();
  TrimOptions options;
  options.longestEdge = -1;
  EXPECT_THROW(TrimTriangles(map, options), Error);
  options.longestEdge = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(TrimTriangles(map, options), Error);
  options.longestEdge = 0;
  options.greatestDepth = 1;
  EXPECT_THROW(TrimTriangles(map, options), Error);
  EXPECT_EQ(map.triangles.size(), 2u) << "nothing was removed";
}

TEST(TrimTriangles, AnEmptyMapStaysEmpty)
{
  DisparityMap map;
  TrimOptions options;
  options.longestEdge = 1;
  TrimTriangles(map, options);
  EXPECT_TRUE(map.triangles.empty());
}
