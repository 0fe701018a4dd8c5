// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/BisectionContour.h"

#include "Common/Error.h"
#include "Contour/Lattice/ContourBlock.h"
#include "Freespace/FreespaceUnion.h"
#include "Support/PlainSettings.h"
#include "Support/ContourFields.h"
#include "Support/MeshTopology.h"
#include "Support/RandomMaps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace freespace;
using Eigen::AlignedBox3d;
using Eigen::Vector3d;

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
    auto unionOptions = Plain(FreespaceUnionOptions());
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
    auto unionOptions = Plain(FreespaceUnionOptions());
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
