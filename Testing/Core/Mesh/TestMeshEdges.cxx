// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Fit/MeshEdges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

using namespace freespace;

TEST(MeshEdges, KnowsWhatIsBesideATriangle)
{
  const MeshEdges edges({ { 0, 1, 2 }, { 2, 1, 3 }, { 4, 5, 6 } }, 7);
  EXPECT_EQ(edges.ends.size(), 8u);
  EXPECT_EQ(edges.opposite[0], (std::array<std::int32_t, 3>{ -1, 1, -1 }));
  EXPECT_EQ(edges.opposite[1], (std::array<std::int32_t, 3>{ 0, -1, -1 }));
  EXPECT_EQ(edges.opposite[2], (std::array<std::int32_t, 3>{ -1, -1, -1 }));
  EXPECT_EQ(edges.ofTriangle[0][1], edges.ofTriangle[1][0]);
}

// Triangles at random, so that many edges have none, one or several triangles beyond them.
TEST(MeshEdges, AgreeWithBruteForce)
{
  std::mt19937 random(2);
  constexpr std::int32_t count = 14;
  for (int trial = 0; trial < 30; ++trial)
  {
    std::vector<std::array<std::int32_t, 3>> triangles;
    for (int i = 0; i < 25; ++i)
    {
      std::array<std::int32_t, count> vertices;
      for (std::int32_t v = 0; v < count; ++v)
      {
        vertices[v] = v;
      }
      std::shuffle(vertices.begin(), vertices.end(), random);
      triangles.push_back({ vertices[0], vertices[1], vertices[2] });
    }
    std::map<std::array<std::int32_t, 2>, std::vector<std::int32_t>> beside;
    const auto endsOf = [&](std::size_t t, int side)
    {
      const std::int32_t a = triangles[t][side], b = triangles[t][(side + 1) % 3];
      return std::array<std::int32_t, 2>{ std::min(a, b), std::max(a, b) };
    };
    for (std::size_t t = 0; t < triangles.size(); ++t)
    {
      for (int side = 0; side < 3; ++side)
      {
        beside[endsOf(t, side)].push_back(static_cast<std::int32_t>(t));
      }
    }
    const MeshEdges edges(triangles, count);
    EXPECT_EQ(edges.ends.size(), beside.size()) << "each edge once";
    for (std::size_t t = 0; t < triangles.size(); ++t)
    {
      for (int side = 0; side < 3; ++side)
      {
        const auto ends = endsOf(t, side);
        EXPECT_EQ(edges.ends[edges.ofTriangle[t][side]], ends);
        const std::vector<std::int32_t>& both = beside[ends];
        const std::int32_t expected = both.size() != 2 ? -1
          : both[0] == static_cast<std::int32_t>(t)    ? both[1]
                                                       : both[0];
        EXPECT_EQ(edges.opposite[t][side], expected);
      }
    }
  }
}

TEST(MeshEdges, WithoutTriangles)
{
  const MeshEdges edges({}, 5);
  EXPECT_TRUE(edges.ends.empty());
  EXPECT_TRUE(edges.opposite.empty());
}
