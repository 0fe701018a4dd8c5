// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/Lattice/Lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

using namespace freespace;
using Eigen::AlignedBox3d;
using Eigen::Vector3d;

TEST(Lattice, TheBoxLiesHalfACellInside)
{
  // Cells of 0.5: 9 along the longest side, of which the outermost are half outside.
  const ContourLattice lattice(AlignedBox3d(Vector3d(1, 2, 3), Vector3d(5, 4, 4)), 9);
  EXPECT_DOUBLE_EQ(lattice.spacing, 0.5);
  EXPECT_EQ(lattice.cells, (LatticeIndex{ 9, 5, 3 }));
  EXPECT_LT((lattice.origin - Vector3d(0.75, 1.75, 2.75)).norm(), 1e-12);
  EXPECT_LT((lattice.Point(9, 5, 3) - Vector3d(5.25, 4.25, 4.25)).norm(), 1e-12);
}

TEST(Lattice, AnyBoxIsCoveredAndCentred)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> side(0.01, 3), place(-10, 10);
  for (int trial = 0; trial < 500; ++trial)
  {
    const Vector3d low(place(random), place(random), place(random));
    const Vector3d size(side(random), side(random), side(random));
    const AlignedBox3d box(low, low + size);
    const int cells = 2 + trial % 50;
    const ContourLattice lattice(box, cells);
    EXPECT_EQ(*std::max_element(lattice.cells.begin(), lattice.cells.end()), cells);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double last = lattice.origin[axis] + lattice.spacing * lattice.cells[axis];
      const double before = box.min()[axis] - lattice.origin[axis], behind = last - box.max()[axis];
      EXPECT_NEAR(before, behind, 1e-9);
      EXPECT_GE(before, (0.5 - 1e-6) * lattice.spacing);
      EXPECT_LT(before, (1 + 1e-6) * lattice.spacing) << "no more cells than needed";
    }
  }
}

TEST(Lattice, PartsOfARangePartitionIt)
{
  std::mt19937 random(2);
  for (int trial = 0; trial < 200; ++trial)
  {
    const int step = 1 + static_cast<int>(random() % 8);
    CellRange range;
    for (int axis = 0; axis < 3; ++axis)
    {
      range.low[axis] = static_cast<int>(random() % 20);
      range.high[axis] = range.low[axis] + 1 + static_cast<int>(random() % 20);
    }
    std::set<LatticeIndex> cells;
    std::size_t count = 0;
    for (const CellRange& part : range.Parts(step))
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_EQ((part.low[axis] - range.low[axis]) % step, 0);
        EXPECT_LT(part.low[axis], part.high[axis]);
        EXPECT_LE(part.high[axis], range.high[axis]);
      }
      for (int i = part.low[0]; i < part.high[0]; ++i)
      {
        for (int j = part.low[1]; j < part.high[1]; ++j)
        {
          for (int k = part.low[2]; k < part.high[2]; ++k)
          {
            cells.insert({ i, j, k });
            ++count;
          }
        }
      }
    }
    const std::size_t all = std::size_t(range.high[0] - range.low[0]) *
      (range.high[1] - range.low[1]) * (range.high[2] - range.low[2]);
    EXPECT_EQ(count, all) << "no cell twice";
    EXPECT_EQ(cells.size(), all) << "each cell";
  }
}

TEST(Lattice, ARangeOfOneStepIsOnePart)
{
  const CellRange range{ { 8, 8, 8 }, { 16, 13, 9 } };
  ASSERT_EQ(range.Parts(8).size(), 1u);
  EXPECT_EQ(range.Parts(8)[0].low, range.low);
  EXPECT_EQ(range.Parts(8)[0].high, range.high);
  EXPECT_EQ(range.Longest(), 8);
  const ContourLattice lattice(AlignedBox3d(Vector3d::Zero(), Vector3d::Constant(15)), 16);
  const AlignedBox3d box = range.Box(lattice);
  EXPECT_LT((box.min() - Vector3d(7.5, 7.5, 7.5)).norm(), 1e-12);
  EXPECT_LT((box.max() - Vector3d(15.5, 12.5, 8.5)).norm(), 1e-12);
}
