// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/SurfaceSummary.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace freespace;

namespace
{

TriangleMesh Tetrahedron()
{
  TriangleMesh mesh;
  mesh.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  mesh.triangles = { { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } };
  return mesh;
}

// Of a ring of rings, which close in both directions.
TriangleMesh Torus(int count)
{
  TriangleMesh mesh;
  const auto at = [count](int i, int k) { return (i % count) * count + k % count; };
  for (int i = 0; i < count; ++i)
  {
    for (int k = 0; k < count; ++k)
    {
      const double u = 2 * M_PI * i / count, v = 2 * M_PI * k / count, r = 2 + std::cos(v);
      mesh.points.push_back({ r * std::cos(u), r * std::sin(u), std::sin(v) });
      mesh.triangles.push_back({ at(i, k), at(i + 1, k), at(i + 1, k + 1) });
      mesh.triangles.push_back({ at(i, k), at(i + 1, k + 1), at(i, k + 1) });
    }
  }
  return mesh;
}

}

TEST(SurfaceSummary, OfATetrahedron)
{
  const SurfaceSummary summary = Summarize(Tetrahedron());
  EXPECT_EQ(summary.points, 4);
  EXPECT_EQ(summary.triangles, 4);
  EXPECT_EQ(summary.edges, 6);
  EXPECT_EQ(summary.components, 1);
  EXPECT_TRUE(summary.IsClosed());
  EXPECT_TRUE(summary.HasManifoldEdges());
  EXPECT_EQ(summary.contraryEdges, 0);
  EXPECT_EQ(summary.EulerCharacteristic(), 2);
  EXPECT_NEAR(summary.volume, 1.0 / 6, 1e-15);
  EXPECT_NEAR(summary.area, 1.5 + std::sqrt(3) / 2, 1e-15);
  EXPECT_EQ(summary.bounds.max(), Eigen::Vector3d::Ones());
}

TEST(SurfaceSummary, OfATorus)
{
  const SurfaceSummary summary = Summarize(Torus(200));
  EXPECT_EQ(summary.EulerCharacteristic(), 0);
  EXPECT_TRUE(summary.IsClosed());
  EXPECT_NEAR(summary.volume, 4 * M_PI * M_PI, 0.03);
  EXPECT_NEAR(summary.area, 8 * M_PI * M_PI, 0.03);
}

TEST(SurfaceSummary, TellsWhatIsWrong)
{
  TriangleMesh mesh = Tetrahedron();
  mesh.points.push_back({ 9, 9, 9 });
  mesh.triangles[3] = { 1, 3, 2 }; // turned over
  SurfaceSummary summary = Summarize(mesh);
  EXPECT_EQ(summary.unusedPoints, 1);
  EXPECT_EQ(summary.contraryEdges, 3);
  EXPECT_EQ(summary.EulerCharacteristic(), 2) << "without the point of no triangle";
  EXPECT_EQ(summary.bounds.max(), Eigen::Vector3d::Ones());
  mesh.triangles.push_back({ 1, 2, 4 }); // a fin
  mesh.triangles.push_back({ 0, 0, 1 });
  summary = Summarize(mesh);
  EXPECT_EQ(summary.crowdedEdges, 2) << "1-2 of the fin, 0-1 of the triangle without area";
  EXPECT_FALSE(summary.IsClosed());
  EXPECT_EQ(summary.flatTriangles, 1);
  EXPECT_EQ(summary.volume, 0);
}

TEST(SurfaceSummary, CountsComponents)
{
  TriangleMesh mesh = Tetrahedron();
  for (const auto& triangle : Tetrahedron().triangles)
  {
    mesh.triangles.push_back({ triangle[0] + 4, triangle[1] + 4, triangle[2] + 4 });
  }
  for (const auto& point : Tetrahedron().points)
  {
    mesh.points.push_back(point + Eigen::Vector3d(5, 0, 0));
  }
  const SurfaceSummary summary = Summarize(mesh);
  EXPECT_EQ(summary.components, 2);
  EXPECT_EQ(summary.EulerCharacteristic(), 4);
  EXPECT_NEAR(summary.volume, 2.0 / 6, 1e-12);
}

TEST(SurfaceSummary, OfNothing)
{
  const SurfaceSummary summary = Summarize(TriangleMesh());
  EXPECT_EQ(summary.components, 0);
  EXPECT_FALSE(summary.IsClosed());
}
