// SPDX-License-Identifier: BSD-3-Clause
// The cells that the octree finds against a look at every cell of the lattice.
#include "Contour/Lattice/ContourOctree.h"

#include "Freespace/FreespaceUnion.h"
#include "Support/ContourFields.h"
#include "Support/PlainSettings.h"
#include "Support/RandomMaps.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

using namespace freespace;

namespace
{

// The case of each cell that the surface passes, by its index; a cell found twice is a failure.
std::map<LatticeIndex, int> FoundCells(const ContourOctree& octree, bool ownOnly = false)
{
  std::map<LatticeIndex, int> found;
  for (const Region& region : octree.regions)
  {
    for (const ContourBlock& block : region.blocks)
    {
      for (std::size_t c = 0; c < block.cells.size(); ++c)
      {
        LatticeIndex cell = ContourBlock::PointOf(static_cast<std::uint16_t>(3 * block.cells[c]));
        for (int axis = 0; axis < 3; ++axis)
        {
          cell[axis] += ContourBlock::Size * block.at[axis];
        }
        if (region.isOwn || !ownOnly)
        {
          EXPECT_TRUE(found.emplace(cell, block.cases[c]).second) << "twice";
        }
      }
    }
  }
  return found;
}

// The same by asking the field at each point of the lattice.
std::map<LatticeIndex, int> AllCells(const ContourOctree& octree)
{
  const ContourLattice& lattice = octree.lattice;
  std::map<LatticeIndex, int> cells;
  for (int k = 0; k < lattice.cells[2]; ++k)
  {
    for (int j = 0; j < lattice.cells[1]; ++j)
    {
      for (int i = 0; i < lattice.cells[0]; ++i)
      {
        int matter = 0;
        for (int corner = 0; corner < 8; ++corner)
        {
          const Eigen::Vector3d point =
            lattice.Point(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2));
          matter |= !octree.field.IsFree(point, octree.field.Root()) << corner;
        }
        if (matter != 0 && matter != 255)
        {
          cells[{ i, j, k }] = matter;
        }
      }
    }
  }
  return cells;
}

void FindCells(ContourOctree& octree)
{
  octree.Find({}, SerialFor, true);
}

}

TEST(ContourOctree, FindsEveryCellThatTheSurfacePasses)
{
  for (unsigned int seed = 0; seed < 8; ++seed)
  {
    const FreespaceUnion phi(RandomMaps(seed, 1 + seed % 4), Plain(FreespaceUnionOptions()));
    ContourOctree octree(phi, phi.Hull().Bounds(), Cells(40));
    FindCells(octree);
    const auto found = FoundCells(octree);
    EXPECT_EQ(found, AllCells(octree)) << "seed " << seed;
    EXPECT_GT(found.size(), 500u) << "seed " << seed;
  }
}

TEST(ContourOctree, OfAFieldThatClassifiesNoBox)
{
  const Ball ball; // the octree keeps a reference
  ContourOctree octree(ball, Cube(1.3), Cells(30));
  FindCells(octree);
  EXPECT_EQ(FoundCells(octree), AllCells(octree));
}

TEST(ContourOctree, PiecesPartitionTheCells)
{
  const FreespaceUnion phi(RandomMaps(6, 3), Plain(FreespaceUnionOptions()));
  ContourOptions options = Cells(90);
  ContourOctree whole(phi, phi.Hull().Bounds(), options);
  FindCells(whole);
  std::map<LatticeIndex, int> together;
  options.pieces = 3;
  for (options.piece = 0; options.piece < 3; ++options.piece)
  {
    ContourOctree piece(phi, phi.Hull().Bounds(), options);
    FindCells(piece);
    for (const auto& cell : FoundCells(piece, true))
    {
      EXPECT_TRUE(together.insert(cell).second) << "in two pieces";
    }
  }
  EXPECT_EQ(together, FoundCells(whole));
}

TEST(ContourOctree, NothingPassesAnEmptyBox)
{
  const Ball ball;
  ContourOctree octree(
    ball, Eigen::AlignedBox3d(Eigen::Vector3d(5, 5, 5), Eigen::Vector3d(6, 6, 6)), Cells(10));
  FindCells(octree);
  EXPECT_TRUE(FoundCells(octree).empty());
}

TEST(ContourOctree, KeysOfPlacesDiffer)
{
  std::set<std::uint64_t> keys;
  for (int i = 0; i < 1000; ++i)
  {
    keys.insert(LatticeKey({ i % 10, i / 10 % 10, i / 100 }));
  }
  keys.insert(LatticeKey({ 65536, 0, 0 }));
  keys.insert(LatticeKey({ 0, 65536, 0 }));
  keys.insert(LatticeKey({ 0, 0, 65536 }));
  EXPECT_EQ(keys.size(), 1003u);
}
