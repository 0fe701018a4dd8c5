// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/BoxGrid.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

using namespace freespace;
using Eigen::AlignedBox3d;
using Eigen::Vector3d;

namespace
{

std::vector<AlignedBox3d> RandomBoxes(int count, std::mt19937& random)
{
  std::uniform_real_distribution<double> place(-3, 3), size(0, 0.6);
  std::vector<AlignedBox3d> boxes;
  for (int i = 0; i < count; ++i)
  {
    const Vector3d low(place(random), place(random), place(random));
    boxes.emplace_back(low, low + Vector3d(size(random), size(random), size(random)));
  }
  return boxes;
}

}

TEST(BoxGrid, FindsAllBoxesThatIntersect)
{
  std::mt19937 random(3);
  for (const int count : { 0, 1, 2, 500 })
  {
    const auto boxes = RandomBoxes(count, random);
    const BoxGrid grid(
      boxes.size(), Vector3d(-2, 0, 1), 0.4, [&](std::size_t i) { return boxes[i]; });
    for (const AlignedBox3d& query : RandomBoxes(100, random))
    {
      std::set<int> found, expected;
      std::set<std::pair<int, std::array<std::int64_t, 3>>> once;
      grid.ForEachNear(query,
        [&](int item, const BoxGrid::Cell& cell)
        {
          ASSERT_LT(item, count);
          if (query.intersects(boxes[item]))
          {
            found.insert(item);
          }
          if (grid.CellOf(query.min().cwiseMax(boxes[item].min())) == cell)
          {
            once.insert({ item, { cell.x(), cell.y(), cell.z() } });
          }
        });
      for (int i = 0; i < count; ++i)
      {
        if (query.intersects(boxes[i]))
        {
          expected.insert(i);
        }
      }
      EXPECT_EQ(found, expected);
      EXPECT_GE(once.size(), expected.size()); // each has one cell of its own
    }
  }
}

TEST(BoxGrid, CellsBeginAtTheOrigin)
{
  const BoxGrid grid(0, Vector3d(1, 2, 3), 0.5, [](std::size_t) { return AlignedBox3d(); });
  EXPECT_EQ(grid.CellOf({ 1, 2, 3 }), BoxGrid::Cell(0, 0, 0));
  EXPECT_EQ(grid.CellOf({ 0.9, 2.6, 4 }), BoxGrid::Cell(-1, 1, 2));
}
