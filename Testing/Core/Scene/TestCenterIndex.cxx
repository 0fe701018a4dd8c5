// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/CenterIndex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace freespace;

TEST(CenterIndex, AgainstBruteForce)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::vector<Eigen::Vector3d> centers;
  for (int i = 0; i < 300; ++i)
  {
    centers.push_back({ coordinate(random), coordinate(random), coordinate(random) });
  }
  const CenterIndex index(centers);
  for (int trial = 0; trial < 50; ++trial)
  {
    const Eigen::Vector3d query(coordinate(random), coordinate(random), coordinate(random));
    std::vector<int> order(centers.size()), within;
    for (int i = 0; i < 300; ++i)
    {
      order[i] = i;
      if ((centers[i] - query).norm() < 0.4)
      {
        within.push_back(i);
      }
    }
    std::sort(order.begin(), order.end(),
      [&](int a, int b)
      { return (centers[a] - query).squaredNorm() < (centers[b] - query).squaredNorm(); });
    order.resize(7);
    EXPECT_EQ(index.Nearest(query, 7), order);
    EXPECT_EQ(index.Within(query, 0.4), within);
  }
}

TEST(CenterIndex, EmptyAndDuplicates)
{
  const CenterIndex empty({});
  EXPECT_TRUE(empty.Nearest({ 0, 0, 0 }, 3).empty());
  EXPECT_TRUE(empty.Within({ 0, 0, 0 }, 3).empty());
  const CenterIndex same(std::vector<Eigen::Vector3d>(100, Eigen::Vector3d(1, 2, 3)));
  EXPECT_EQ(same.Nearest({ 0, 0, 0 }, 5).size(), 5u);
  EXPECT_EQ(same.Within({ 1, 2, 3 }, 0.1).size(), 100u);
}
