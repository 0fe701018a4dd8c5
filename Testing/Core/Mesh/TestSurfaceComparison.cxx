// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Distance/SurfaceComparison.h"

#include "Common/Error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

// A square in the plane z = height over [0, width] x [0, 1].
TriangleMesh SquareMesh(double height, double width = 1)
{
  TriangleMesh mesh;
  mesh.points = { { 0, 0, height }, { width, 0, height }, { width, 1, height }, { 0, 1, height } };
  mesh.triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  return mesh;
}

SurfaceComparisonOptions LimitOptions(std::vector<double> limits)
{
  SurfaceComparisonOptions options;
  options.limits = std::move(limits);
  options.samples = 20000;
  return options;
}

}

TEST(SurfaceComparison, OfParallelSquaresIsTheirDistance)
{
  const auto figures = CompareSurfaces(SquareMesh(0.25), SquareMesh(0), LimitOptions({ 0.3, 0.2 }));
  for (const SurfaceDistances& way : { figures.ofSurface, figures.ofReference })
  {
    EXPECT_EQ(way.samples, 20000u);
    EXPECT_NEAR(way.mean, 0.25, 1e-12);
    EXPECT_NEAR(way.rootMeanSquare, 0.25, 1e-12);
    EXPECT_NEAR(way.median, 0.25, 1e-15);
    EXPECT_NEAR(way.greatest, 0.25, 1e-15);
    EXPECT_NEAR(way.meanAngle, 0, 1e-9);
    ASSERT_EQ(way.within.size(), 2u);
    EXPECT_EQ(way.within[0], 0) << "ascending limits";
    EXPECT_EQ(way.within[1], 1);
    ASSERT_EQ(way.histogram.size(), 51u);
    EXPECT_EQ(way.histogram[41], 20000u) << "0.25 / 0.3 of 50 bins";
  }
  EXPECT_EQ(figures.F(0), 0);
  EXPECT_EQ(figures.F(1), 1);
}

TEST(SurfaceComparison, TellsWhatIsMissingFromWhatIsWrong)
{
  // Half of the reference: what there is is right, and the other half is up to 1 away, evenly.
  const auto figures = CompareSurfaces(SquareMesh(0, 1), SquareMesh(0, 2), LimitOptions({ 0.5 }));
  EXPECT_EQ(figures.Accuracy(0), 1);
  EXPECT_NEAR(figures.ofSurface.greatest, 0, 1e-12);
  EXPECT_NEAR(figures.Completeness(0), 0.75, 0.01);
  EXPECT_NEAR(figures.ofReference.mean, 0.25, 0.01);
  EXPECT_NEAR(figures.ofReference.rootMeanSquare, std::sqrt(1 / 6.0), 0.01);
  EXPECT_NEAR(figures.ofReference.greatest, 1, 1e-12);
  EXPECT_NEAR(figures.F(0), 2 * 0.75 / 1.75, 0.01);
  const double expected[] = { 0, 1, 1, 0 };
  for (int i = 0; i < 4; ++i)
  {
    EXPECT_NEAR(figures.ofReference.atPoints[i], expected[i], 1e-12);
  }
  const auto& histogram = figures.ofReference.histogram;
  EXPECT_EQ(std::accumulate(histogram.begin(), histogram.end(), std::size_t(0)), 20000u);
  EXPECT_NEAR(histogram.back() / 20000.0, 0.25, 0.01);
}

TEST(SurfaceComparison, TellsTheAngleBetweenTheNormals)
{
  TriangleMesh tilted = SquareMesh(0);
  for (Vector3d& point : tilted.points)
  {
    point.z() = point.x(); // 45 degrees
  }
  EXPECT_NEAR(
    CompareSurfaces(tilted, SquareMesh(0), LimitOptions({ 1 })).ofSurface.medianAngle, 45, 1e-9);
  TriangleMesh turned = SquareMesh(0.1);
  turned.triangles = { { 0, 2, 1 }, { 0, 3, 2 } };
  EXPECT_NEAR(
    CompareSurfaces(turned, SquareMesh(0), LimitOptions({ 1 })).ofSurface.meanAngle, 180, 1e-9);
}

TEST(SurfaceComparison, DoesNotDependOnHowTheSurfaceIsCut)
{
  // One half in a thousand triangles, and a distance of its own.
  TriangleMesh cut = SquareMesh(0.1);
  const int strips = 1000;
  for (int i = 0; i <= strips; ++i)
  {
    cut.points.push_back({ 1 + double(i) / strips, 0, 0.3 });
    cut.points.push_back({ 1 + double(i) / strips, 1, 0.3 });
  }
  for (int i = 0; i < strips; ++i)
  {
    const int a = 4 + 2 * i;
    cut.triangles.push_back({ a, a + 2, a + 3 });
    cut.triangles.push_back({ a, a + 3, a + 1 });
  }
  const auto figures = CompareSurfaces(cut, SquareMesh(0, 2), LimitOptions({ 0.2 }));
  EXPECT_NEAR(figures.ofSurface.mean, 0.2, 1e-4);
  EXPECT_NEAR(figures.Accuracy(0), 0.5, 1e-3);
  SurfaceComparisonOptions corners = LimitOptions({ 0.2 });
  corners.samples = 0;
  EXPECT_NEAR(CompareSurfaces(cut, SquareMesh(0, 2), corners).Accuracy(0), 4.0 / 2006, 1e-12);
}

TEST(SurfaceComparison, ChoosesLimitsByTheReference)
{
  SurfaceComparisonOptions options;
  options.samples = 10;
  const auto limits = CompareSurfaces(SquareMesh(0), SquareMesh(0, 2), options).limits;
  const double diagonal = std::sqrt(5);
  ASSERT_EQ(limits.size(), 3u);
  EXPECT_NEAR(limits[0], 0.001 * diagonal, 1e-15);
  EXPECT_NEAR(limits[1], 0.002 * diagonal, 1e-15);
  EXPECT_NEAR(limits[2], 0.005 * diagonal, 1e-15);
}

TEST(SurfaceComparison, RefusesWhatHasNoArea)
{
  TriangleMesh line = SquareMesh(0);
  line.triangles = { { 0, 1, 1 } };
  EXPECT_THROW(CompareSurfaces(line, SquareMesh(0), LimitOptions({ 1 })), Error);
  EXPECT_THROW(CompareSurfaces(SquareMesh(0), TriangleMesh(), LimitOptions({ 1 })), Error);
  TriangleMesh infinite = SquareMesh(0);
  infinite.points[2].x() = HUGE_VAL;
  EXPECT_THROW(CompareSurfaces(SquareMesh(0), infinite, LimitOptions({ 1 })), Error);
  EXPECT_THROW(CompareSurfaces(SquareMesh(0), SquareMesh(0), LimitOptions({ 0 })), Error);
  EXPECT_THROW(
    CompareSurfaces(SquareMesh(0), SquareMesh(0), LimitOptions({ std::nan("") })), Error);
}
