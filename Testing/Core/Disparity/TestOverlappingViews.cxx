// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/OverlappingViews.h"

#include "Support/RandomMaps.h"
#include "ViewFreespace/ViewFreespace.h"

#include <gtest/gtest.h>

using namespace freespace;
using Eigen::Vector3d;

TEST(OverlappingViews, WhoeverClaimsAPlaceThatAnotherSeesOverlapsIt)
{
  int apart = 0, together = 0;
  for (unsigned int seed = 0; seed < 20; ++seed)
  {
    std::vector<DisparityMap> maps = RandomMaps(seed, 12);
    // Some of them are far away.
    std::mt19937 random(seed);
    for (DisparityMap& map : maps)
    {
      const Vector3d shift(4.0 * (random() % 4), 0, 0);
      map.camera.t -= map.camera.R * shift;
      for (Vector3d& point : map.points)
      {
        point += shift;
      }
    }
    const auto overlapping = OverlappingViews(maps);
    for (std::size_t v = 0; v < maps.size(); ++v)
    {
      for (std::size_t w = 0; w < maps.size(); ++w)
      {
        const auto& others = overlapping[v];
        const bool found = std::binary_search(others.begin(), others.end(), static_cast<int>(w));
        ASSERT_FALSE(v == w && found);
        (found ? together : apart) += 1;
        if (v == w || found)
        {
          continue;
        }
        const ViewFreespace other(maps[w]);
        for (const auto& triangle : maps[v].triangles)
        {
          const Vector3d place = (maps[v].points[triangle[0]] + maps[v].points[triangle[1]] +
                                   maps[v].points[triangle[2]]) /
            3;
          ASSERT_FALSE(other.IsFree(place));
        }
      }
    }
  }
  EXPECT_GT(apart, 500);
  EXPECT_GT(together, 500);
}

TEST(OverlappingViews, MapsWithoutUsablePointsMeetNobody)
{
  std::vector<DisparityMap> maps = RandomMaps(1, 3);
  maps[1].points.assign(maps[1].points.size(), Vector3d::Constant(NAN));
  const auto overlapping = OverlappingViews(maps);
  EXPECT_TRUE(overlapping[1].empty());
  EXPECT_EQ(overlapping[0], std::vector<int>{ 2 });
  EXPECT_TRUE(OverlappingViews({}).empty());
}
