// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/BisectionContour.h"

#include "Contour/Lattice/ContourBlock.h"
#include "Contour/Lattice/ContourEstimate.h"
#include "Freespace/FreespaceUnion.h"
#include "Support/MeshTopology.h"
#include "Support/RandomMaps.h"

#include <gtest/gtest.h>

#include <random>
#include <thread>

using namespace freespace;
using Eigen::AlignedBox3d;
using Eigen::Vector3d;

namespace
{

class Ball : public ContourField
{
public:
  bool IsFree(const Vector3d& point, const FieldScope&) const override
  {
    return point.norm() > 1.0;
  }
};

// Matter or free by a coin for each lattice point: every case of the cubes, side by side.
class Noise : public ContourField
{
public:
  explicit Noise(unsigned int seed)
    : Seed(seed)
  {
  }
  bool IsFree(const Vector3d& point, const FieldScope&) const override
  {
    const auto cell = [](double x)
    { return static_cast<std::uint64_t>(std::floor(x * 16 + 1000)); };
    std::uint64_t h = this->Seed;
    for (double x : { point.x(), point.y(), point.z() })
    {
      h = (h ^ cell(x)) * 0x9e3779b97f4a7c15u;
      h ^= h >> 29;
    }
    return h >> 11 & 1;
  }

private:
  std::uint64_t Seed;
};

AlignedBox3d Cube(double half)
{
  return AlignedBox3d(Vector3d::Constant(-half), Vector3d::Constant(half));
}

ContourOptions Cells(int cells)
{
  ContourOptions options;
  options.cells = cells;
  return options;
}

void ThreeThreads(
  std::size_t count, const std::function<void(std::size_t begin, std::size_t end)>& body)
{
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i)
  {
    threads.emplace_back([&body, count, i] { body(count * i / 3, count * (i + 1) / 3); });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
}

}

TEST(BisectionContour, BallHasItsVolumeAndItsVerticesOnTheSphere)
{
  ContourOptions options = Cells(40);
  options.tolerance = 1e-5;
  const ContourMesh mesh = BisectionContour(Ball(), Cube(1.3), options);
  EXPECT_EQ(TopologyFaults(mesh), "");
  EXPECT_NEAR(EnclosedVolume(mesh), 4.0 / 3.0 * M_PI, 0.02);
  const double spacing = 2.6 / 39;
  for (const Vector3d& p : mesh.points)
  {
    EXPECT_NEAR(p.norm(), 1.0, 0.011 * spacing);
  }
}

TEST(BisectionContour, MatterThatReachesTheBoundsIsClosedThere)
{
  const ContourMesh mesh = BisectionContour(Ball(), Cube(0.5), Cells(20));
  EXPECT_EQ(TopologyFaults(mesh), "");
  // A cube, but for its edges and corners, which the cells cut off.
  EXPECT_NEAR(EnclosedVolume(mesh), 1.0, 0.02);
  for (const Vector3d& p : mesh.points)
  {
    EXPECT_NEAR(p.cwiseAbs().maxCoeff(), 0.5, 0.001);
  }
}

TEST(BisectionContour, NoiseIsManifold)
{
  for (unsigned int seed = 1; seed < 20; ++seed)
  {
    const ContourMesh mesh = BisectionContour(Noise(seed), Cube(0.6), Cells(21));
    EXPECT_EQ(TopologyFaults(mesh), "") << "seed " << seed;
    EXPECT_GT(mesh.triangles.size(), 5000u);
    EXPECT_GT(EnclosedVolume(mesh), 0);
  }
}

TEST(BisectionContour, UnionByBoxesIsTheSameAsByPoints)
{
  // The same union, but no box is ever classified.
  class PointByPoint : public ContourField
  {
  public:
    explicit PointByPoint(const FreespaceUnion& phi)
      : Phi(phi)
    {
    }
    bool IsFree(const Vector3d& point, const FieldScope&) const override
    {
      return this->Phi.IsFree(point);
    }
    const FreespaceUnion& Phi;
  };
  for (unsigned int seed = 0; seed < 20; ++seed)
  {
    FreespaceUnionOptions unionOptions;
    unionOptions.minimumViews = seed % 5 > 0 ? 1 + seed % 2 : 1; // not more than there are
    const FreespaceUnion phi(RandomMaps(seed, 1 + seed % 5), unionOptions);
    ContourOptions options = Cells(30 + seed);
    options.exact = false;
    const ContourMesh mesh = BisectionContour(phi, phi.Hull().Bounds(), options);
    const ContourMesh plain = BisectionContour(PointByPoint(phi), phi.Hull().Bounds(), options);
    EXPECT_EQ(TopologyFaults(mesh), "") << "seed " << seed;
    EXPECT_EQ(mesh.points, plain.points);
    EXPECT_EQ(mesh.triangles, plain.triangles);
    EXPECT_GT(mesh.triangles.size(), 100u);
    EXPECT_GT(EnclosedVolume(mesh), 0);
    const ContourMesh threaded =
      BisectionContour(phi, phi.Hull().Bounds(), options, {}, ThreeThreads);
    EXPECT_EQ(mesh.points, threaded.points);
    EXPECT_EQ(mesh.triangles, threaded.triangles);
    EXPECT_EQ(mesh.view, threaded.view);
  }
}

TEST(BisectionContour, ExactCrossingsAreWhereBisectionFindsThem)
{
  for (unsigned int seed = 0; seed < 20; ++seed)
  {
    // Also where two or three views have to agree.
    FreespaceUnionOptions unionOptions;
    const int views = 1 + seed % 5;
    unionOptions.minimumViews = seed < 10 ? 1 : std::min(views, 2 + static_cast<int>(seed % 2));
    const FreespaceUnion phi(RandomMaps(seed, views), unionOptions);
    ContourOptions options = Cells(30);
    const ContourMesh exact = BisectionContour(phi, phi.Hull().Bounds(), options);
    options.exact = false;
    options.tolerance = 1e-6;
    const ContourMesh bisected = BisectionContour(phi, phi.Hull().Bounds(), options);
    ASSERT_EQ(exact.triangles, bisected.triangles);
    EXPECT_EQ(TopologyFaults(exact), "");
    const double spacing = phi.Hull().Bounds().sizes().maxCoeff() / 29;
    std::size_t far = 0, unchanged = 0, clear = 0, otherLabel = 0;
    const Vector3d origin = ContourLattice(phi.Hull().Bounds(), options.cells).origin;
    for (std::size_t i = 0; i < exact.points.size(); ++i)
    {
      // An edge that is crossed more than once has more than one answer; the surface is at each.
      const Vector3d& p = exact.points[i];
      const Vector3d cell = (p - origin) / spacing;
      const Vector3d off = cell - cell.array().round().matrix();
      Eigen::Index axis;
      if (off.cwiseAbs().maxCoeff(&axis) > 0.0101)
      {
        const Vector3d step = 2e-6 * spacing * Vector3d::Unit(axis);
        unchanged += phi.IsFree(p - step) == phi.IsFree(p + step);
        far += (p - bisected.points[i]).norm() > 2e-6 * spacing;
        ++clear;
      }
    }
    EXPECT_GT(clear, exact.points.size() * 8 / 10);
    EXPECT_EQ(unchanged, 0u);
    EXPECT_LE(far, clear / 10);
    for (std::size_t t = 0; t < exact.triangles.size(); ++t)
    {
      otherLabel += exact.view[t] != bisected.view[t] || exact.kind[t] != bisected.kind[t];
    }
    EXPECT_LE(otherLabel, exact.triangles.size() / 10);
  }
}

TEST(BisectionContour, PiecesTogetherAreTheWhole)
{
  const FreespaceUnion phi(RandomMaps(6, 3), {});
  ContourOptions options = Cells(90);
  const auto corners = [](const ContourMesh& mesh, std::size_t t)
  {
    std::array<std::array<double, 3>, 3> triangle;
    for (int i = 0; i < 3; ++i)
    {
      const Vector3d& p = mesh.points[mesh.triangles[t][i]];
      triangle[i] = { p.x(), p.y(), p.z() };
    }
    return triangle;
  };
  for (int trial = 0; trial < 6; ++trial)
  {
    options.sharp = trial % 2 == 1;
    options.pieces = 1;
    options.piece = 0;
    const ContourMesh whole = BisectionContour(phi, phi.Hull().Bounds(), options);
    EXPECT_EQ(whole.ownPoints, whole.points.size());
    options.pieces = std::array<int, 3>{ 2, 5, 1000 }[trial / 2];
    std::size_t next = 0, nextPoint = 0;
    for (options.piece = 0; options.piece < options.pieces; ++options.piece)
    {
      const ContourMesh piece = BisectionContour(phi, phi.Hull().Bounds(), options);
      std::vector<char> used(piece.points.size(), 0);
      for (std::size_t t = 0; t < piece.triangles.size(); ++t, ++next)
      {
        ASSERT_LT(next, whole.triangles.size());
        ASSERT_EQ(corners(piece, t), corners(whole, next));
        ASSERT_EQ(piece.view[t], whole.view[next]);
        for (int corner : piece.triangles[t])
        {
          used[corner] = 1;
        }
      }
      EXPECT_EQ(std::count(used.begin() + piece.ownPoints, used.end(), 0), 0);
      for (std::size_t v = 0; v < piece.ownPoints; ++v, ++nextPoint)
      {
        ASSERT_LT(nextPoint, whole.points.size());
        ASSERT_EQ(piece.points[v], whole.points[nextPoint]);
      }
    }
    EXPECT_EQ(next, whole.triangles.size());
    EXPECT_EQ(nextPoint, whole.points.size());
  }
}

TEST(BisectionContour, TrianglesKnowWhatTheyAre)
{
  const std::vector<DisparityMap> maps = RandomMaps(4, 1);
  const FreespaceUnion phi(maps, {});
  const ContourMesh mesh = BisectionContour(phi, phi.Hull().Bounds(), Cells(60));
  int count[3] = { 0, 0, 0 };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    ++count[static_cast<int>(mesh.kind[t])];
    EXPECT_EQ(mesh.view[t], mesh.kind[t] == SurfaceKind::Hull ? -1 : 0);
  }
  EXPECT_GT(count[0], 100); // the map's triangles
  EXPECT_GT(count[1], 100); // the walls under its border, down to the margin of the hull
  EXPECT_GT(count[2], 100); // the hull
}

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

// A cube whose faces have ripples much finer than the lattice, as the union of noisy views has.
TEST(BisectionContour, SharpModeRebuildsTheEdgesOfARoughCube)
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

INSTANTIATE_TEST_SUITE_P(BisectionContour, SharpCube, testing::Range(0u, 38u));

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

// Their vertices keep a hundredth of a cell from the sides; that must not part them from each other.
TEST(BisectionContour, SharpEdgesBesideTheSidesOfCellsHangTogether)
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
TEST(BisectionContour, SharpModeRebuildsTheEdgesOfHundredsOfCubes)
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

TEST(BisectionContour, AwkwardInput)
{
  EXPECT_TRUE(BisectionContour(Ball(), AlignedBox3d(), {}).points.empty());
  const AlignedBox3d away(Vector3d(5, 5, 5), Vector3d(6, 6, 6));
  EXPECT_TRUE(BisectionContour(Ball(), away, Cells(10)).points.empty());
  EXPECT_THROW(BisectionContour(Ball(), Cube(NAN), {}), Error);
  EXPECT_THROW(BisectionContour(Ball(), Cube(HUGE_VAL), {}), Error);
  EXPECT_THROW(BisectionContour(Ball(), Cube(0), {}), Error);
  EXPECT_THROW(BisectionContour(Ball(), Cube(1), Cells(1)), Error);
  // Flat bounds have a lattice of one cell across; nothing has thickness there.
  const AlignedBox3d flat(Vector3d(-1, -1, 0), Vector3d(1, 1, 0));
  EXPECT_EQ(TopologyFaults(BisectionContour(Ball(), flat, Cells(20))), "");
}

TEST(BisectionContour, EstimatesItsSize)
{
  const FreespaceUnion phi(RandomMaps(6, 3), {});
  const AlignedBox3d bounds = phi.Hull().Bounds();
  for (int cells : { 120, 300 })
  {
    const double triangles = BisectionContour(phi, bounds, Cells(cells)).triangles.size();
    const double estimate = EstimateContour(phi, bounds, Cells(cells)).triangles;
    EXPECT_NEAR(estimate / triangles, 1.0, 0.15) << cells;
  }
  // What nobody could make is known as quickly: four times as much for every halved cell.
  const double some = EstimateContour(phi, bounds, Cells(240)).megabytes;
  const double many = EstimateContour(phi, bounds, Cells(256 * 240)).megabytes;
  EXPECT_NEAR(many / some / (256.0 * 256.0), 1.0, 0.15);
  EXPECT_EQ(EstimateContour(Ball(), Cube(1.3), Cells(100)).triangles, 0); // answers for points only
}

TEST(BisectionContour, KeepsToItsMemoryLimit)
{
  const FreespaceUnion phi(RandomMaps(6, 3), {});
  const AlignedBox3d bounds = phi.Hull().Bounds();
  ContourOptions options = Cells(150);
  const double needed = EstimateContour(phi, bounds, options).megabytes;
  ASSERT_GT(needed, 1);
  options.memoryLimit = 1.3 * needed;
  const std::size_t triangles = BisectionContour(phi, bounds, options).triangles.size();
  options.memoryLimit = needed / 2;
  EXPECT_THROW(BisectionContour(phi, bounds, options), Error);
  options.pieces = 4; // each of which fits
  std::size_t sum = 0;
  for (options.piece = 0; options.piece < 4; ++options.piece)
  {
    sum += BisectionContour(phi, bounds, options).triangles.size();
  }
  EXPECT_EQ(sum, triangles);
  ContourOptions large = Cells(65536);
  large.memoryLimit = 1000;
  EXPECT_THROW(BisectionContour(phi, bounds, large), Error);
  // A field that cannot tell is stopped when it has become too large.
  ContourOptions untold = Cells(100);
  untold.memoryLimit = 0.1;
  EXPECT_THROW(BisectionContour(Ball(), Cube(1.3), untold), Error);
  untold.memoryLimit = -1;
  EXPECT_THROW(BisectionContour(Ball(), Cube(1.3), untold), Error);
}

TEST(BisectionContour, StopsOnRequest)
{
  int calls = 0;
  const Progress stopAtHalf(
    [&calls](double fraction)
    {
      ++calls;
      return fraction < 0.5;
    });
  EXPECT_THROW(BisectionContour(Ball(), Cube(1.3), Cells(100), stopAtHalf), Aborted);
  EXPECT_GT(calls, 3);
}
