// SPDX-License-Identifier: BSD-3-Clause
#include "Epipolar/PieceGroup.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

using namespace freespace;

namespace
{

std::vector<PieceGroup> RandomGroups(std::mt19937& random, int count)
{
  std::uniform_real_distribution<float> row(0, 1), column(0, 100), unit(-1, 1);
  std::vector<PieceGroup> groups(count);
  int token = 0;
  for (PieceGroup& group : groups)
  {
    for (int k = 0; k < PieceGroup::Size; ++k)
    {
      group.low[k] = row(random);
      group.high[k] = row(random); // below the low one: of an empty piece
      group.u[k] = column(random);
      group.slope[k] = unit(random);
      group.tangentU[k] = unit(random);
      group.tangentV[k] = unit(random);
      group.width[k] = row(random);
      group.token[k] = token++;
    }
  }
  return groups;
}

}

// Whichever part of the groups is searched.
TEST(PieceGroup, CrossingsAreThoseOfBruteForce)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<float> row(0, 1), column(-10, 110), unit(-1, 1);
  int found = 0;
  for (int trial = 0; trial < 2000; ++trial)
  {
    const std::vector<PieceGroup> groups = RandomGroups(random, 1 + trial % 4);
    const int count = static_cast<int>(groups.size()) * PieceGroup::Size;
    const int begin = static_cast<int>(random() % (count + 1));
    const int end = begin + static_cast<int>(random() % (count - begin + 1));
    const RowSearch search = { { column(random), column(random), unit(random), unit(random),
                                 0.5f * row(random) },
      row(random), row(random) };
    std::vector<PieceCrossing> crossings(count);
    crossings.resize(FindCrossings(groups.data(), begin, end, search, crossings.data()));
    std::size_t next = 0;
    for (int i = begin; i < end; ++i)
    {
      const PieceGroup& group = groups[i / PieceGroup::Size];
      const int k = i % PieceGroup::Size;
      const float u = group.u[k] + search.down * group.slope[k];
      const float cosine = std::abs(
        search.edge.tangentU * group.tangentU[k] + search.edge.tangentV * group.tangentV[k]);
      if (search.row >= group.low[k] && search.row < group.high[k] && u >= search.edge.near &&
        u < search.edge.far && cosine >= search.edge.minimumCosine)
      {
        ASSERT_LT(next, crossings.size());
        const PieceCrossing& crossing = crossings[next++];
        EXPECT_EQ(crossing.token, i);
        EXPECT_EQ(crossing.u, u);
        EXPECT_EQ(crossing.cosine, cosine);
        EXPECT_EQ(crossing.width, group.width[k]);
      }
    }
    EXPECT_EQ(next, crossings.size());
    found += static_cast<int>(next);
  }
  EXPECT_GT(found, 200);
}

// [low, high) and [near, far), and the cosine that is asked for is enough.
TEST(PieceGroup, BoundsAreHalfOpen)
{
  PieceGroup group{};
  group.low[3] = 1;
  group.high[3] = 2;
  group.u[3] = 5;
  group.tangentU[3] = 1;
  group.token[3] = 42;
  const auto count = [&](float row, float near, float far, float cosine)
  {
    PieceCrossing found[PieceGroup::Size];
    return FindCrossings(
      &group, 0, PieceGroup::Size, { { near, far, -1, 0, cosine }, row, 0 }, found);
  };
  EXPECT_EQ(count(1, 5, 6, 1), 1);
  EXPECT_EQ(count(2, 5, 6, 1), 0);
  EXPECT_EQ(count(1, 4, 5, 1), 0);
  EXPECT_EQ(count(1, 5, 6, 1.001f), 0);
  EXPECT_EQ(count(0.999f, 5, 6, 1), 0);
}
