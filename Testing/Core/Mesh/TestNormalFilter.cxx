// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Fit/NormalFilter.h"

#include "Common/Error.h"
#include "Support/Core/TwoThreads.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <random>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

struct FoldedMesh
{
  std::vector<Vector3d> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

// A strip of squares, folded up along the line x = 0 by an angle in radians.
FoldedMesh Fold(double angle, int half = 12)
{
  FoldedMesh mesh;
  const int side = 2 * half + 1;
  for (int i = -half; i <= half; ++i)
  {
    for (int j = 0; j < side; ++j)
    {
      const double along = std::max(i, 0);
      mesh.points.emplace_back(
        std::min(i, 0) + along * std::cos(angle), j, along * std::sin(angle));
    }
  }
  for (int i = 0; i + 1 < side; ++i)
  {
    for (int j = 0; j + 1 < side; ++j)
    {
      const int a = i * side + j, b = a + side;
      mesh.triangles.push_back({ a, b, b + 1 });
      mesh.triangles.push_back({ a, b + 1, a + 1 });
    }
  }
  return mesh;
}

struct FaceNormals
{
  std::vector<Vector3d> normals;
  std::vector<double> areas;

  explicit FaceNormals(const FoldedMesh& mesh)
  {
    TriangleNormals(mesh.points, mesh.triangles, normals, areas);
  }
};

double LargestDifference(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b)
{
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    largest = std::max(largest, (a[i] - b[i]).norm());
  }
  return largest;
}

double MeanDifference(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b)
{
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += (a[i] - b[i]).norm();
  }
  return sum / static_cast<double>(a.size());
}

std::vector<Vector3d> WithNoise(std::vector<Vector3d> normals, double deviation)
{
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0, deviation);
  for (Vector3d& normal : normals)
  {
    normal = (normal + Vector3d(noise(random), noise(random), noise(random))).normalized();
  }
  return normals;
}

}

TEST(NormalFilter, NormalsAndAreasOfTriangles)
{
  const std::vector<Vector3d> points = { { 0, 0, 0 }, { 3, 0, 0 }, { 0, 4, 0 }, { 6, 0, 0 } };
  std::vector<Vector3d> normals;
  std::vector<double> areas;
  TriangleNormals(points, { { 0, 1, 2 }, { 0, 2, 1 }, { 0, 1, 3 } }, normals, areas);
  EXPECT_EQ(normals, (std::vector<Vector3d>{ { 0, 0, 1 }, { 0, 0, -1 }, { 0, 0, 0 } }));
  EXPECT_EQ(areas, (std::vector<double>{ 6, 6, 0 }));
}

TEST(NormalFilter, WithoutIterationsNothingChanges)
{
  const FoldedMesh mesh = Fold(0.3);
  const FaceNormals faces(mesh);
  std::vector<Vector3d> normals = WithNoise(faces.normals, 0.2);
  const std::vector<Vector3d> before = normals;
  NormalFilterOptions options;
  options.iterations = 0;
  FilterNormals(normals, faces.areas, MeshEdges(mesh.triangles, mesh.points.size()), options);
  EXPECT_LT(LargestDifference(normals, before), 1e-6);
}

// Normals that differ by more than 2.45 deviations do not mix at all: each side keeps its own.
TEST(NormalFilter, ASharpEdgeStays)
{
  const FoldedMesh mesh = Fold(M_PI / 2);
  const FaceNormals faces(mesh);
  std::vector<Vector3d> normals = faces.normals;
  NormalFilterOptions options;
  options.deviation = 0.25; // guides mix up to 2.45 * 0.5 < sqrt(2)
  FilterNormals(normals, faces.areas, MeshEdges(mesh.triangles, mesh.points.size()), options);
  EXPECT_LT(LargestDifference(normals, faces.normals), 1e-6);
}

TEST(NormalFilter, ASlightFoldIsRounded)
{
  const FoldedMesh mesh = Fold(0.2);
  const FaceNormals faces(mesh);
  std::vector<Vector3d> normals = faces.normals;
  FilterNormals(
    normals, faces.areas, MeshEdges(mesh.triangles, mesh.points.size()), NormalFilterOptions());
  EXPECT_GT(LargestDifference(normals, faces.normals), 0.02);
}

TEST(NormalFilter, NoiseIsSmoothedOnBothSidesOfAnEdge)
{
  const FoldedMesh mesh = Fold(M_PI / 2);
  const FaceNormals faces(mesh);
  const std::vector<Vector3d> noisy = WithNoise(faces.normals, 0.15);
  std::vector<Vector3d> normals = noisy;
  FilterNormals(
    normals, faces.areas, MeshEdges(mesh.triangles, mesh.points.size()), NormalFilterOptions());
  EXPECT_LT(MeanDifference(normals, faces.normals), 0.35 * MeanDifference(noisy, faces.normals));
  for (const Vector3d& normal : normals)
  {
    EXPECT_NEAR(normal.norm(), 1, 1e-6);
  }
}

// The mean of normals is that by area: a triangle without one is given its neighbours' normal.
TEST(NormalFilter, TrianglesWithoutAreaTakeTheNormalBesideThem)
{
  const std::vector<std::array<std::int32_t, 3>> triangles = { { 0, 1, 2 }, { 2, 1, 3 } };
  std::vector<Vector3d> normals = { { 0, 0, 1 }, { 0.1, 0, 1 } };
  normals[1].normalize();
  NormalFilterOptions options;
  options.iterations = 1;
  FilterNormals(normals, { 2, 0 }, MeshEdges(triangles, 4), options);
  EXPECT_LT((normals[0] - Vector3d(0, 0, 1)).norm(), 1e-6);
  EXPECT_LT((normals[1] - Vector3d(0, 0, 1)).norm(), 1e-6);
}

TEST(NormalFilter, IsTheSameForAnyThreads)
{
  const FoldedMesh mesh = Fold(0.4);
  const FaceNormals faces(mesh);
  const MeshEdges edges(mesh.triangles, mesh.points.size());
  std::vector<Vector3d> one = WithNoise(faces.normals, 0.15), two = one;
  FilterNormals(one, faces.areas, edges, NormalFilterOptions());
  FilterNormals(two, faces.areas, edges, NormalFilterOptions(), TwoThreads);
  EXPECT_EQ(one, two);
}

TEST(NormalFilter, OptionsOutOfRange)
{
  NormalFilterOptions options;
  EXPECT_NO_THROW(options.Check());
  options.iterations = -1;
  EXPECT_THROW(options.Check(), Error);
  options.iterations = 0;
  for (const double deviation : { 0.0, -1.0, double(NAN), double(INFINITY) })
  {
    options.deviation = deviation;
    EXPECT_THROW(options.Check(), Error) << deviation;
  }
}
