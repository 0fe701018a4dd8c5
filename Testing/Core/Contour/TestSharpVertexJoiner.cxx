// SPDX-License-Identifier: BSD-3-Clause
// The joining of sharp vertices: whatever they are, the surface does not intersect itself.
#include "Contour/Sharp/SharpVertexJoiner.h"

#include "Contour/Sharp/SharpVertexFinder.h"
#include "Mesh/TriangleIntersections.h"
#include "Support/ContourFields.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

// Noise whose normals are noise, too: sharp vertices anywhere about their cells.
class NoisyNormals : public Noise
{
public:
  using Noise::Noise;
  SurfaceLabel Label(const Vector3d& free, const Vector3d& matter, const FieldScope&) const override
  {
    const Vector3d place = 1e4 * (free + matter);
    std::seed_seq seed{ std::llround(place.x()), std::llround(place.y()), std::llround(place.z()) };
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const Vector3d off(normal(random), normal(random), normal(random));
    return { 0, SurfaceKind::Feature, ((free - matter).normalized() + 0.5 * off).normalized() };
  }
};

// A cube of side 1 that is turned about a diagonal.
class DiagonalCube : public ContourField
{
public:
  explicit DiagonalCube(double angle)
    : Turn(Eigen::AngleAxisd(angle, Vector3d(1, 1, 1).normalized()).matrix())
  {
  }
  bool IsFree(const Vector3d& point, const FieldScope&) const override
  {
    return (this->Turn * point).cwiseAbs().maxCoeff() > 0.5;
  }
  SurfaceLabel Label(const Vector3d& free, const Vector3d&, const FieldScope&) const override
  {
    const Vector3d p = this->Turn * free;
    Eigen::Index axis;
    p.cwiseAbs().maxCoeff(&axis);
    return { 0, SurfaceKind::Feature,
      this->Turn.transpose() * Vector3d(std::copysign(1.0, p[axis]) * Vector3d::Unit(axis)) };
  }

private:
  Eigen::Matrix3d Turn;
};

// The blocks of a contour with their sharp vertices. Keeps a reference to the field.
class SharpBlocks
{
public:
  SharpBlocks(const ContourField& field, double half, int cells)
    : Parts(field, Cube(half), SharpCells(cells))
    , Blocks(this->Parts.lattice)
  {
    this->Parts.Find(Progress(), SerialFor, false);
    this->Blocks.Add(this->Parts.regions);
    FindSharpEdges(
      this->Parts.field, ContourOptions().sharpAngle, this->Blocks, Progress(), SerialFor);
  }

  void Join() { JoinSharpVertices(false, this->Blocks, Progress(), SerialFor); }

  // All of them, in the order of their places.
  std::vector<SharpVertex> Vertices() const
  {
    std::vector<SharpVertex> vertices;
    for (const BlockPlace& place : this->Blocks.places)
    {
      vertices.insert(vertices.end(), place.sharp.begin(), place.sharp.end());
    }
    return vertices;
  }

  std::size_t CountLinks() const
  {
    std::size_t links = 0;
    for (const BlockPlace& place : this->Blocks.places)
    {
      links += place.links.size();
    }
    return links;
  }

  // Pairs of triangles that intersect, of which one has a sharp vertex: the others are within their cells.
  std::size_t CountIntersections() const
  {
    std::vector<Vector3d> points;
    std::vector<std::int32_t> triangles, first;
    std::vector<std::size_t> suspects;
    for (const BlockPlace& place : this->Blocks.places)
    {
      first.push_back(static_cast<std::int32_t>(points.size()));
      for (std::size_t v = 0; v < place.NumberOfVertices(); ++v)
      {
        const std::size_t ordinary = place.block->keys.size();
        points.push_back(v < ordinary ? place.block->Position(this->Blocks.lattice, v)
                                      : place.sharp[v - ordinary].position);
      }
    }
    for (const BlockPlace& place : this->Blocks.places)
    {
      EXPECT_TRUE(this->Blocks.ForEachTriangle(place,
        [&](std::size_t, const std::array<BlockVertex, 3>& corners, bool isSharp, int)
        {
          if (isSharp)
          {
            suspects.push_back(triangles.size() / 3);
          }
          for (const BlockVertex& corner : corners)
          {
            triangles.push_back(first[corner.owner - this->Blocks.places.data()] +
              static_cast<std::int32_t>(corner.vertex));
          }
        }));
    }
    const TriangleSoup soup = { [&](std::int32_t vertex) { return points[vertex]; },
      triangles.data(), triangles.size() / 3 };
    return FindIntersections(
      soup, suspects, this->Blocks.lattice.spacing, [](std::size_t, std::size_t) { return true; })
      .size();
  }

private:
  static ContourOptions SharpCells(int cells)
  {
    ContourOptions options = Cells(cells);
    options.sharp = true; // the blocks keep normals
    return options;
  }

  ContourOctree Parts;
  BlockMesh Blocks;
};

}

TEST(SharpVertexJoiner, NothingIsJoinedInAnEmptyLattice)
{
  class Nothing : public ContourField
  {
  public:
    bool IsFree(const Vector3d&, const FieldScope&) const override { return true; }
  };
  const Nothing nothing;
  SharpBlocks blocks(nothing, 1, 8);
  blocks.Join();
  EXPECT_TRUE(blocks.Vertices().empty());
  EXPECT_EQ(blocks.CountLinks(), 0u);
}

TEST(SharpVertexJoiner, ASmoothSurfaceHasNothingToJoin)
{
  class LabelledBall : public Ball
  {
  public:
    SurfaceLabel Label(const Vector3d& free, const Vector3d&, const FieldScope&) const override
    {
      return { 0, SurfaceKind::Feature, free.normalized() };
    }
  };
  const LabelledBall ball;
  SharpBlocks blocks(ball, 1.2, 24);
  blocks.Join();
  EXPECT_TRUE(blocks.Vertices().empty());
  EXPECT_EQ(blocks.CountIntersections(), 0u);
}

// Vertices are where they were or back in their cells, and the surface does not intersect itself.
TEST(SharpVertexJoiner, CubesKeepTheirVerticesWithoutIntersections)
{
  std::size_t links = 0;
  int outside = 0, back = 0;
  for (int trial = 0; trial < 12; ++trial)
  {
    const DiagonalCube cube(0.05 + 0.17 * trial);
    SharpBlocks blocks(cube, 1.1, 24);
    const std::vector<SharpVertex> given = blocks.Vertices();
    ASSERT_GT(given.size(), 100u);
    blocks.Join();
    EXPECT_EQ(blocks.CountIntersections(), 0u) << trial;
    links += blocks.CountLinks();
    const std::vector<SharpVertex> joined = blocks.Vertices();
    ASSERT_EQ(joined.size(), given.size());
    for (std::size_t i = 0; i < given.size(); ++i)
    {
      outside += given[i].reach != Reach::Own;
      if (joined[i].reach != given[i].reach)
      {
        ++back;
        EXPECT_EQ(joined[i].reach, Reach::Own);
        EXPECT_EQ(joined[i].position, given[i].fallback);
      }
      else
      {
        EXPECT_EQ(joined[i].position, given[i].position);
      }
    }
  }
  EXPECT_GT(outside, 50) << "there is something to decide";
  EXPECT_LT(back, outside / 2);
  EXPECT_GT(links, 20u);
}

TEST(SharpVertexJoiner, NoiseDoesNotIntersectItself)
{
  std::size_t before = 0;
  int back = 0;
  for (unsigned int seed = 0; seed < 8; ++seed)
  {
    const NoisyNormals noise(seed);
    SharpBlocks blocks(noise, 0.5, 14);
    const std::vector<SharpVertex> given = blocks.Vertices();
    before += blocks.CountIntersections();
    blocks.Join();
    EXPECT_EQ(blocks.CountIntersections(), 0u) << seed;
    const std::vector<SharpVertex> joined = blocks.Vertices();
    for (std::size_t i = 0; i < given.size(); ++i)
    {
      back += joined[i].reach != given[i].reach;
    }
  }
  EXPECT_GT(before, 5u) << "without the joiner it would";
  EXPECT_GT(back, 0);
}
