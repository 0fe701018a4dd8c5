// SPDX-License-Identifier: BSD-3-Clause
// The sharp contour: vertices on the edges and corners of a surface, and their joining.
#include "Contour/Sharp/SharpVertexFinder.h"

#include "Contour/BisectionContour.h"
#include "Contour/Lattice/ContourBlock.h"
#include "Support/ContourFields.h"
#include "Support/MeshTopology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

using namespace freespace;
using Eigen::AlignedBox3d;
using Eigen::Vector3d;

namespace
{

// A cube of side 1, turned and moved, that knows nothing of itself but the normals of its faces.
class TurnedCube : public ContourField
{
public:
  explicit TurnedCube(unsigned int seed)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto vector = [&] { return Vector3d(uniform(random), uniform(random), uniform(random)); };
    if (seed > 0)
    {
      this->Turn = Eigen::AngleAxisd(M_PI * uniform(random), vector().normalized()).matrix();
      this->Center = 0.1 * vector();
    }
  }
  bool IsFree(const Vector3d& point, const FieldScope&) const override
  {
    return (this->Turn * (point - this->Center)).cwiseAbs().maxCoeff() > 0.5;
  }
  SurfaceLabel Label(const Vector3d& free, const Vector3d&, const FieldScope&) const override
  {
    const Vector3d p = this->Turn * (free - this->Center);
    Eigen::Index axis;
    p.cwiseAbs().maxCoeff(&axis);
    return { 0, SurfaceKind::Feature,
      this->Turn.transpose() * Vector3d(std::copysign(1.0, p[axis]) * Vector3d::Unit(axis)) };
  }
  Vector3d FromCube(const Vector3d& p) const { return this->Turn.transpose() * p + this->Center; }

  Eigen::Matrix3d Turn = Eigen::Matrix3d::Identity();
  Vector3d Center = Vector3d::Zero();
};

// How many of eleven places on each edge of the cube are further than a length from all edges of a
// mesh, and how many of its corners from all vertices.
std::pair<int, int> CountFar(const TurnedCube& cube, const ContourMesh& mesh, double length)
{
  int places = 0, corners = 0;
  for (int edge = 0; edge < 12; ++edge)
  {
    for (int i = 0; i <= 10; ++i)
    {
      Vector3d p;
      p[edge / 4] = 0.1 * i - 0.5;
      p[(edge / 4 + 1) % 3] = edge & 1 ? 0.5 : -0.5;
      p[(edge / 4 + 2) % 3] = edge & 2 ? 0.5 : -0.5;
      p = cube.FromCube(p);
      double toEdge = HUGE_VAL, toVertex = HUGE_VAL;
      for (const auto& t : mesh.triangles)
      {
        // Triangles are smaller than three cells; all others are further than one cell.
        if ((mesh.points[t[0]] - p).squaredNorm() > 0.1)
        {
          continue;
        }
        for (int c = 0; c < 3; ++c)
        {
          const Vector3d &a = mesh.points[t[c]], &b = mesh.points[t[(c + 1) % 3]];
          const double s = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
          toEdge = std::min(toEdge, (a + s * (b - a) - p).norm());
          toVertex = std::min(toVertex, (a - p).norm());
        }
      }
      places += toEdge > length;
      corners += (i == 0 || i == 10) && toVertex > length;
    }
  }
  return { places, corners / 3 };
}

}

// A cube whose faces have ripples much finer than the lattice, as the union of noisy views has.
TEST(SharpVertexFinder, SharpModeRebuildsTheEdgesOfARoughCube)
{
  constexpr int cells = 32;
  constexpr double cell = 1.7 / (cells - 1), height = 0.045 * cell,
                   frequency = 2 * M_PI / (0.43 * cell);
  class Block : public ContourField
  {
  public:
    // How far a face goes beyond 0.5 at a place on it.
    static double Ripple(const Vector3d& p, int axis)
    {
      return height * std::sin(frequency * p[(axis + 1) % 3]) *
        std::sin(frequency * p[(axis + 2) % 3]);
    }
    bool IsFree(const Vector3d& point, const FieldScope&) const override
    {
      const Vector3d p = this->Turn * point;
      for (int axis = 0; axis < 3; ++axis)
      {
        if (std::abs(p[axis]) > 0.5 + Ripple(p, axis))
        {
          return true;
        }
      }
      return false;
    }
    SurfaceLabel Label(const Vector3d& free, const Vector3d&, const FieldScope&) const override
    {
      const Vector3d p = this->Turn * free;
      Eigen::Index axis;
      p.cwiseAbs().maxCoeff(&axis);
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      Vector3d normal = std::copysign(1.0, p[axis]) * Vector3d::Unit(axis);
      normal[a] = -height * frequency * std::cos(frequency * p[a]) * std::sin(frequency * p[b]);
      normal[b] = -height * frequency * std::sin(frequency * p[a]) * std::cos(frequency * p[b]);
      return { 0, SurfaceKind::Feature, this->Turn.transpose() * normal.normalized() };
    }
    Eigen::Matrix3d Turn;
  };
  Block block;
  block.Turn = Eigen::AngleAxisd(0.2, Vector3d(1, 2, 3).normalized()).matrix();
  ContourOptions options = Cells(cells);
  options.tolerance = 1e-5;
  options.sharp = true;
  const ContourMesh sharp = BisectionContour(block, Cube(0.85), options);
  EXPECT_EQ(TopologyFaults(sharp), "");
  // How far short of the cube's edges the surface stays.
  const int samples = 40;
  int far = 0;
  for (int i = 0; i < 12 * samples; ++i)
  {
    const int edge = i / samples, axis = edge / 4;
    Vector3d p;
    p[axis] = (i % samples + 0.5) / samples - 0.5;
    p[(axis + 1) % 3] = edge & 1 ? 0.5 : -0.5;
    p[(axis + 2) % 3] = edge & 2 ? 0.5 : -0.5;
    const Vector3d place = block.Turn.transpose() * p;
    double least = HUGE_VAL;
    for (const auto& t : sharp.triangles)
    {
      for (int k = 0; k < 3; ++k)
      {
        const Vector3d &a = sharp.points[t[k]], &b = sharp.points[t[(k + 1) % 3]];
        const double s = std::clamp((place - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
        least = std::min(least, (a + s * (b - a) - place).norm());
      }
    }
    far += least > 0.25 * cell;
  }
  EXPECT_LE(far, 12 * samples / 20);
}

namespace
{

class SharpCube : public testing::TestWithParam<unsigned int>
{
};

}

TEST_P(SharpCube, HasItsEdgesAndCornersToATenthOfACell)
{
  const TurnedCube cube(GetParam());
  ContourOptions options = Cells(32);
  options.tolerance = 1e-5;
  const AlignedBox3d bounds = Cube(1.1);
  const double cell = 2.2 / 31;
  const ContourMesh plain = BisectionContour(cube, bounds, options);
  options.sharp = true;
  const ContourMesh sharp = BisectionContour(cube, bounds, options);
  EXPECT_EQ(TopologyFaults(sharp), "");
  EXPECT_NEAR(EnclosedVolume(sharp), 1.0, 0.0005);
  EXPECT_TRUE(
    GetParam() == 0 || CountFar(cube, plain, 0.1 * cell).first > 66); // it means something
  const auto [places, corners] = CountFar(cube, sharp, 0.1 * cell);
  EXPECT_EQ(places, 0);
  EXPECT_EQ(corners, 0);
}

INSTANTIATE_TEST_SUITE_P(SharpVertexFinder, SharpCube, testing::Range(0u, 38u));

namespace
{

// A cube whose normals are off by some 10 degrees, as those of a rough surface are.
class CubeOfRoughNormals : public TurnedCube
{
public:
  using TurnedCube::TurnedCube;
  SurfaceLabel Label(
    const Vector3d& free, const Vector3d& matter, const FieldScope& scope) const override
  {
    SurfaceLabel label = this->TurnedCube::Label(free, matter, scope);
    const Vector3d far = 1e4 * free;
    std::mt19937 random(static_cast<unsigned int>(
      std::llround(far.x()) + 1000 * std::llround(far.y()) + 1000000 * std::llround(far.z())));
    std::uniform_real_distribution<double> off(-0.25, 0.25);
    label.normal += Vector3d(off(random), off(random), off(random));
    label.normal.normalize();
    return label;
  }
};

}

// Their vertices keep a hundredth of a cell from the sides; that must not part them from each other.
TEST(SharpVertexFinder, SharpEdgesBesideTheSidesOfCellsHangTogether)
{
  const ContourLattice lattice(Cube(1.1), 32);
  for (double beside : { -0.012, -0.008, -0.003, 0.003, 0.008, 0.012 })
  {
    CubeOfRoughNormals cube(0);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double side = lattice.origin[axis] + (20 + axis + beside) * lattice.spacing;
      cube.Center[axis] = side - 0.5;
    }
    ContourOptions options = Cells(32);
    options.tolerance = 1e-5;
    options.sharp = true;
    const ContourMesh sharp = BisectionContour(cube, Cube(1.1), options);
    EXPECT_EQ(TopologyFaults(sharp), "");
    EXPECT_LE(CountFar(cube, sharp, 0.2 * lattice.spacing).first, 7) << beside;
  }
}

// Also where a corner pokes through cells along their diagonals. Where an edge comes by between two
// points of the lattice without any near it, its ends in the cells before and behind are joined with a
// chord past the empty cell: that costs half as much again, at about one rotation in eighty.
TEST(SharpVertexFinder, SharpModeRebuildsTheEdgesOfHundredsOfCubes)
{
  const double cell = 2.2 / 31;
  int imperfect = 0;
  for (unsigned int seed = 38; seed < 400; ++seed)
  {
    const TurnedCube cube(seed);
    ContourOptions options = Cells(32);
    options.tolerance = 1e-5;
    options.sharp = true;
    const ContourMesh sharp = BisectionContour(cube, Cube(1.1), options);
    EXPECT_EQ(TopologyFaults(sharp), "") << "seed " << seed;
    EXPECT_EQ(CountFar(cube, sharp, 0.15 * cell), std::make_pair(0, 0)) << "seed " << seed;
    const auto [places, corners] = CountFar(cube, sharp, 0.1 * cell);
    EXPECT_LE(places, 1) << "seed " << seed;
    EXPECT_EQ(corners, 0) << "seed " << seed;
    imperfect += places;
  }
  EXPECT_LE(imperfect, 5);
}
