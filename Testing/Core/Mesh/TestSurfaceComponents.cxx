// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/SurfaceComponents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

using namespace freespace;

TEST(SurfaceComponents, HangTogetherByPoints)
{
  const std::vector<std::array<std::int64_t, 3>> triangles = { { 5, 6, 7 }, { 0, 1, 2 },
    { 8, 9, 5 }, { 3, 4, 2 } };
  EXPECT_EQ(ComponentsOf(triangles, 11), (std::vector<std::int32_t>{ 0, 1, 0, 1 }));
  EXPECT_TRUE(ComponentsOf({}, 3).empty());
}

TEST(SurfaceComponents, OfAStripInAnyOrderAreOne)
{
  std::vector<std::array<std::int64_t, 3>> strip;
  for (int i = 0; i < 1000; ++i)
  {
    strip.push_back({ i, i + 1, i + 2 });
  }
  std::shuffle(strip.begin(), strip.end(), std::mt19937(3));
  const std::vector<std::int32_t> component = ComponentsOf(strip, 1002);
  EXPECT_EQ(std::count(component.begin(), component.end(), 0), 1000);
}

TEST(SurfaceComponents, CrumbsAreWhatNothingSupports)
{
  const std::vector<std::int32_t> component = { 0, 1, 1, 1, 2, 2, 3 };
  // The largest stays even if nothing supports it.
  EXPECT_EQ(SupportedComponents(component, { 0, 0, 0, 0, 0, 1, 0 }),
    (std::vector<char>{ 0, 1, 1, 1, 1, 1, 0 }));
  EXPECT_TRUE(SupportedComponents({}, {}).empty());
}

// Against spreading the least number of a triangle through all that it touches.
TEST(SurfaceComponents, AgreeWithBruteForce)
{
  std::mt19937 random(4);
  for (int trial = 0; trial < 50; ++trial)
  {
    const std::int64_t points = 3 + static_cast<std::int64_t>(random() % 60);
    std::vector<std::array<std::int64_t, 3>> triangles(random() % 30);
    for (auto& triangle : triangles)
    {
      for (std::int64_t& corner : triangle)
      {
        corner = static_cast<std::int64_t>(random() % points);
      }
    }
    std::vector<std::size_t> least(triangles.size());
    for (std::size_t t = 0; t < least.size(); ++t)
    {
      least[t] = t;
    }
    for (std::size_t round = 0; round < least.size(); ++round)
    {
      for (std::size_t a = 0; a < least.size(); ++a)
      {
        for (std::size_t b = 0; b < least.size(); ++b)
        {
          if (std::find_first_of(triangles[a].begin(), triangles[a].end(), triangles[b].begin(),
                triangles[b].end()) != triangles[a].end())
          {
            least[a] = std::min(least[a], least[b]);
          }
        }
      }
    }
    std::map<std::size_t, std::int32_t> numbers;
    std::vector<std::int32_t> expected;
    for (const std::size_t first : least)
    {
      expected.push_back(
        numbers.emplace(first, static_cast<std::int32_t>(numbers.size())).first->second);
    }
    EXPECT_EQ(ComponentsOf(triangles, points), expected);
  }
}
