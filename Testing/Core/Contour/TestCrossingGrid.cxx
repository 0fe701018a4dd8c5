// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/Sharp/CrossingGrid.h"

#include "Support/ContourFields.h"

#include <gtest/gtest.h>

#include <map>
#include <tuple>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

// Noise whose crossings can be told from each other by their normals.
class NoiseWithPlaces : public Noise
{
public:
  using Noise::Noise;
  SurfaceLabel Label(const Vector3d& free, const Vector3d& matter, const FieldScope&) const override
  {
    return { 0, SurfaceKind::Feature, 0.5 * (free + matter) };
  }
};

// The blocks of a contour. Keeps a reference to the field.
struct GridBlocks
{
  GridBlocks(const ContourField& field, double half, int cells)
    : parts(field, Cube(half), KeepNormals(cells))
    , mesh(this->parts.lattice)
  {
    this->parts.Find(Progress(), SerialFor, false);
    this->mesh.Add(this->parts.regions);
  }
  static ContourOptions KeepNormals(int cells)
  {
    ContourOptions options = Cells(cells);
    options.sharp = true;
    return options;
  }

  ContourOctree parts;
  BlockMesh mesh;
};

using LatticeEdge = std::pair<LatticeIndex, int>; // its first point and its axis

// Of all blocks, by edge of the lattice.
std::map<LatticeEdge, SurfacePlane> AllCrossings(const BlockMesh& mesh)
{
  std::map<LatticeEdge, SurfacePlane> crossings;
  for (const BlockPlace& place : mesh.places)
  {
    const ContourBlock& block = *place.block;
    for (std::size_t v = 0; v < block.keys.size(); ++v)
    {
      const LatticeIndex point = ContourBlock::PointOf(block.keys[v]);
      crossings[{
        { 8 * block.at[0] + point[0], 8 * block.at[1] + point[1], 8 * block.at[2] + point[2] },
        block.keys[v] % 3 }] = { block.Position(mesh.lattice, v), block.normals[v].cast<double>() };
    }
  }
  return crossings;
}

// Those of the lattice edges that begin in a range of a block's points, last ones included.
std::vector<SurfacePlane> CrossingsFrom(const std::map<LatticeEdge, SurfacePlane>& all,
  const ContourBlock& block, const LatticeIndex& low, const LatticeIndex& high)
{
  std::vector<SurfacePlane> planes;
  for (int k = low[2]; k <= high[2]; ++k)
  {
    for (int j = low[1]; j <= high[1]; ++j)
    {
      for (int i = low[0]; i <= high[0]; ++i)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          const auto found =
            all.find({ { 8 * block.at[0] + i, 8 * block.at[1] + j, 8 * block.at[2] + k }, axis });
          if (found != all.end())
          {
            planes.push_back(found->second);
          }
        }
      }
    }
  }
  return planes;
}

void ExpectSamePlanes(
  const std::vector<SurfacePlane>& planes, const std::vector<SurfacePlane>& expected)
{
  ASSERT_EQ(planes.size(), expected.size());
  for (std::size_t i = 0; i < planes.size(); ++i)
  {
    EXPECT_EQ(planes[i].point, expected[i].point);
    EXPECT_EQ(planes[i].normal, expected[i].normal);
  }
}

}

TEST(CrossingGrid, EachEdgeHasAPlaceOfItsOwn)
{
  std::vector<int> count(3 * 11 * 11 * 11, 0);
  for (int k = -3; k < 13; ++k)
  {
    for (int j = -3; j < 13; ++j)
    {
      for (int i = -3; i < 13; ++i)
      {
        const bool isInside = std::min({ i, j, k }) >= -1 && std::max({ i, j, k }) <= 9;
        EXPECT_EQ(CrossingGrid::Has({ i, j, k }), isInside) << i << " " << j << " " << k;
        for (int axis = 0; axis < 3 && isInside; ++axis)
        {
          ++count.at(CrossingGrid::Place({ i, j, k }, axis));
        }
      }
    }
  }
  EXPECT_EQ(std::count(count.begin(), count.end(), 1), 3 * 11 * 11 * 11);
}

TEST(CrossingGrid, HoldsTheCrossingsOfAllBlocksAround)
{
  for (unsigned int seed = 1; seed < 4; ++seed)
  {
    const NoiseWithPlaces noise(seed);
    const GridBlocks blocks(noise, 1.03, 25);
    const auto all = AllCrossings(blocks.mesh);
    ASSERT_GT(blocks.mesh.places.size(), 60u)
      << "of 64: inner ones and those at the lattice's border";
    CrossingGrid again; // the same for all blocks: what it held before is gone
    for (const BlockPlace& place : blocks.mesh.places)
    {
      CrossingGrid grid;
      grid.Fill(blocks.mesh, place);
      again.Fill(blocks.mesh, place);
      std::vector<SurfacePlane> planes, planesAgain;
      for (int k = -1; k <= 9; ++k)
      {
        for (int j = -1; j <= 9; ++j)
        {
          for (int i = -1; i <= 9; ++i)
          {
            for (int axis = 0; axis < 3; ++axis)
            {
              grid.Add({ i, j, k }, axis, planes);
              again.Add({ i, j, k }, axis, planesAgain);
            }
          }
        }
      }
      const auto expected = CrossingsFrom(all, *place.block, { -1, -1, -1 }, { 9, 9, 9 });
      EXPECT_EQ(grid.crossings.size(), expected.size());
      ExpectSamePlanes(planes, expected);
      ExpectSamePlanes(planesAgain, expected);
    }
  }
}

TEST(CrossingGrid, AroundACellAreTheEdgesFromThePointsOfItsNeighbours)
{
  const NoiseWithPlaces noise(5);
  const GridBlocks blocks(noise, 1.03, 14);
  const auto all = AllCrossings(blocks.mesh);
  std::size_t most = 0;
  for (const BlockPlace& place : blocks.mesh.places)
  {
    CrossingGrid grid;
    grid.Fill(blocks.mesh, place);
    for (const std::uint16_t key : place.block->cells)
    {
      const LatticeIndex cell = BlockMesh::CellOf(key);
      std::vector<SurfacePlane> planes;
      grid.AddAround(cell, planes);
      ExpectSamePlanes(planes,
        CrossingsFrom(all, *place.block, { cell[0] - 1, cell[1] - 1, cell[2] - 1 },
          { cell[0] + 2, cell[1] + 2, cell[2] + 2 }));
      most = std::max(most, planes.size());
    }
  }
  EXPECT_GT(most, 80u) << "of 192 edges, half cross";
}

TEST(CrossingGrid, ABlockAloneHasItsOwnCrossings)
{
  class SmallBall : public ContourField
  {
  public:
    bool IsFree(const Vector3d& point, const FieldScope&) const override
    {
      return point.norm() > 0.5;
    }
  };
  const SmallBall ball;
  const GridBlocks blocks(ball, 1, 8); // 8 cells and so one block
  ASSERT_EQ(blocks.mesh.places.size(), 1u);
  CrossingGrid grid;
  grid.Fill(blocks.mesh, blocks.mesh.places[0]);
  EXPECT_EQ(grid.crossings.size(), blocks.mesh.places[0].block->keys.size());
  for (const SurfacePlane& plane : grid.crossings)
  {
    EXPECT_NEAR(plane.point.norm(), 0.5, 1e-3);
  }
  std::vector<SurfacePlane> planes;
  grid.Add({ -1, -1, -1 }, 0, planes);
  grid.Add({ 9, 9, 9 }, 2, planes);
  EXPECT_TRUE(planes.empty());
}
