// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Distance/TriangleTree.h"

#include "Support/Core/TwoThreads.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <thread>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

double ToSegment(const Vector3d& p, const Vector3d& a, const Vector3d& b)
{
  const double squared = (b - a).squaredNorm();
  const double t = squared > 0 ? std::clamp((p - a).dot(b - a) / squared, 0.0, 1.0) : 0;
  return (a + t * (b - a) - p).norm();
}

// Another way than the library's: the least of the plane, where the point is above the triangle, and the edges.
double ToTriangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  const double edges = std::min({ ToSegment(p, a, b), ToSegment(p, b, c), ToSegment(p, c, a) });
  const Vector3d normal = (b - a).cross(c - a);
  const bool isAbove = normal.norm() > 0 && (b - a).cross(p - a).dot(normal) >= 0 &&
    (c - b).cross(p - b).dot(normal) >= 0 && (a - c).cross(p - c).dot(normal) >= 0;
  return isAbove ? std::abs(normal.normalized().dot(p - a)) : edges;
}

double NearestByBruteForce(const Vector3d& p, const TriangleMesh& mesh)
{
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : mesh.triangles)
  {
    least = std::min(least, ToTriangle(p, mesh.points[a], mesh.points[b], mesh.points[c]));
  }
  return least;
}

struct RandomNumbers
{
  std::mt19937 engine;
  explicit RandomNumbers(unsigned seed)
    : engine(seed)
  {
  }
  Vector3d Point(double half = 1)
  {
    std::uniform_real_distribution<double> coordinate(-half, half);
    const double x = coordinate(engine), y = coordinate(engine);
    return { x, y, coordinate(engine) };
  }
  int Index(int count) { return std::uniform_int_distribution<int>(0, count - 1)(engine); }
};

TriangleMesh RandomMesh(RandomNumbers& random, int points, int triangles, const Vector3d& middle)
{
  TriangleMesh mesh;
  for (int i = 0; i < points; ++i)
  {
    mesh.points.push_back(middle + random.Point());
  }
  for (int i = 0; i < triangles; ++i)
  {
    mesh.triangles.push_back({ random.Index(points), random.Index(points), random.Index(points) });
  }
  return mesh;
}

}

TEST(TriangleTree, IsBruteForceForRandomTriangles)
{
  for (unsigned seed = 1; seed <= 60; ++seed)
  {
    RandomNumbers random(seed);
    const int triangles = seed <= 20 ? static_cast<int>(seed) : random.Index(700) + 1;
    // Corners that are the same point make triangles without area; far from the origin digits are few.
    const Vector3d middle = seed % 3 == 0 ? Vector3d(5e5, -4e6, 100) : Vector3d::Zero();
    const TriangleMesh mesh = RandomMesh(random, 3 + random.Index(300), triangles, middle);
    std::vector<Vector3d> points = mesh.points;
    for (int i = 0; i < 100; ++i)
    {
      points.push_back(middle + random.Point(i < 50 ? 1.2 : 1000));
    }
    const auto found = TriangleTree(mesh).Find(points);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const double expected = NearestByBruteForce(points[i], mesh);
      const double room = 1e-12 * (1 + expected) + (seed % 3 == 0 ? 1e-9 : 0);
      ASSERT_NEAR(found[i].distance, expected, room) << seed << ", point " << i;
      const auto& [a, b, c] = mesh.triangles[found[i].triangle];
      ASSERT_NEAR(
        ToTriangle(points[i], mesh.points[a], mesh.points[b], mesh.points[c]), expected, room);
    }
  }
}

TEST(TriangleTree, IsBruteForceForNeedlesAndOutliers)
{
  RandomNumbers random(5);
  TriangleMesh mesh;
  for (int i = 0; i < 200; ++i) // needles: two corners near to each other, or three in a line
  {
    const Vector3d a = random.Point(), b = random.Point();
    mesh.points.insert(mesh.points.end(),
      { a, b, i % 2 ? Vector3d(a + 1e-9 * random.Point()) : Vector3d(0.3 * a + 0.7 * b) });
    mesh.triangles.push_back({ 3 * i, 3 * i + 1, 3 * i + 2 });
  }
  mesh.points.push_back({ 1e7, 0, 0 });
  mesh.triangles.push_back({ 0, 1, 600 });
  std::vector<Vector3d> points;
  for (int i = 0; i < 500; ++i)
  {
    points.push_back(random.Point(1.5));
  }
  const auto found = TriangleTree(mesh).Find(points);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_NEAR(found[i].distance, NearestByBruteForce(points[i], mesh), 1e-8);
  }
}

TEST(TriangleTree, IsTheSameForAnyNumberOfThreads)
{
  RandomNumbers random(7);
  const TriangleMesh mesh = RandomMesh(random, 500, 3000, Vector3d::Zero());
  std::vector<Vector3d> points;
  for (int i = 0; i < 5000; ++i)
  {
    points.push_back(random.Point());
  }
  const auto one = TriangleTree(mesh).Find(points);
  const auto two = TriangleTree(mesh, TwoThreads).Find(points, HUGE_VAL, TwoThreads);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_EQ(one[i].triangle, two[i].triangle);
    EXPECT_EQ(one[i].distance, two[i].distance);
  }
}

TEST(TriangleTree, FindsNothingBeyondItsReach)
{
  TriangleMesh mesh;
  mesh.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  mesh.triangles = { { 0, 1, 2 } };
  const TriangleTree tree(mesh);
  const auto found = tree.Find({ { 0.2, 0.2, 0.5 }, { 0.2, 0.2, 0.51 } }, 0.505);
  EXPECT_DOUBLE_EQ(found[0].distance, 0.5);
  EXPECT_EQ(found[0].triangle, 0);
  EXPECT_EQ(found[1].triangle, -1);
  EXPECT_TRUE(std::isinf(found[1].distance));
}

TEST(TriangleTree, TakesNothingAndNumbersThatAreNotFinite)
{
  TriangleMesh mesh;
  EXPECT_TRUE(TriangleTree(mesh).IsEmpty());
  EXPECT_EQ(TriangleTree(mesh).Find({ Vector3d::Zero() })[0].triangle, -1);
  const double nan = std::nan("");
  mesh.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { nan, 0, 0 } };
  mesh.triangles = { { 0, 1, 3 } };
  EXPECT_TRUE(TriangleTree(mesh).IsEmpty());
  mesh.triangles.push_back({ 0, 1, 2 });
  const auto found = TriangleTree(mesh).Find({ { nan, 0, 0 }, { HUGE_VAL, 0, 0 }, { 2, 0, 0 } });
  EXPECT_EQ(found[0].triangle, -1);
  EXPECT_EQ(found[1].triangle, -1);
  EXPECT_EQ(found[2].triangle, 1);
  EXPECT_DOUBLE_EQ(found[2].distance, 1);
}
