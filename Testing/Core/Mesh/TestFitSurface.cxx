// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Fit/FitSurface.h"

#include "Common/Error.h"
#include "Contour/BisectionContour.h"
#include "Mesh/Fit/TriangleGrid.h"
#include "Mesh/TriangleIntersections.h"
#include "Mesh/Fit/Untangle.h"
#include "Mesh/Fit/VertexSystem.h"
#include "Support/MeshTopology.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <map>
#include <numeric>
#include <random>
#include <thread>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

constexpr double Half = 0.6;

// A cube whose faces are squares of two triangles each, with vertices on its edges and corners.
ContourMesh BoxMesh(int cells = 16)
{
  ContourMesh mesh;
  std::map<std::array<int, 3>, std::int32_t> known;
  const auto vertex = [&](const std::array<int, 3>& at)
  {
    const auto place = known.emplace(at, static_cast<std::int32_t>(mesh.points.size()));
    if (place.second)
    {
      mesh.points.push_back(
        Half * (2.0 / cells * Vector3d(at[0], at[1], at[2]) - Vector3d::Ones()));
    }
    return place.first->second;
  };
  for (int face = 0; face < 6; ++face)
  {
    const int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int i = 0; i < cells; ++i)
    {
      for (int j = 0; j < cells; ++j)
      {
        std::int32_t corners[4];
        for (int k = 0; k < 4; ++k)
        {
          std::array<int, 3> at;
          at[axis] = face % 2 ? cells : 0;
          at[u] = i + (k == 1 || k == 2);
          at[v] = j + (k >= 2);
          corners[k] = vertex(at);
        }
        if (face % 2 == 0)
        {
          std::swap(corners[1], corners[3]);
        }
        mesh.triangles.push_back({ corners[0], corners[1], corners[2] });
        mesh.triangles.push_back({ corners[0], corners[2], corners[3] });
      }
    }
  }
  return mesh;
}

double HeightOverBox(const Vector3d& p)
{
  return p.cwiseAbs().maxCoeff() - Half;
}

// Vertices along their own directions, not all at once to one side.
void AddNoise(std::vector<Vector3d>& points, double deviation)
{
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, deviation);
  for (Vector3d& p : points)
  {
    p += Vector3d(noise(random), noise(random), noise(random));
  }
}

// Seen from ten times the box' size away, on the three faces that look there.
std::vector<SeenFeature> FeaturesOnBox(double deviation)
{
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, deviation);
  std::uniform_real_distribution<double> place(-0.6, 0.6);
  std::vector<SeenFeature> features;
  for (int i = 0; i < 24000; ++i)
  {
    const int axis = i % 3;
    const double side = i % 2 ? 1 : -1;
    Vector3d p(place(random), place(random), place(random));
    p[axis] = side * Half + noise(random);
    const Vector3d eye = 10 * side * (Vector3d::Unit(axis) + Vector3d::Constant(0.3));
    features.push_back({ p, p - eye });
  }
  return features;
}

double RootMeanSquare(const std::vector<Vector3d>& points)
{
  double sum = 0;
  for (const Vector3d& p : points)
  {
    sum += std::pow(HeightOverBox(p), 2);
  }
  return std::sqrt(sum / points.size());
}

std::size_t Intersections(
  const std::vector<Vector3d>& points, const std::vector<std::array<std::int32_t, 3>>& triangles)
{
  TriangleSoup soup;
  soup.position = [&](std::int32_t v) { return points[v]; };
  soup.triangles = triangles.front().data();
  soup.count = triangles.size();
  std::vector<std::size_t> all(triangles.size());
  std::iota(all.begin(), all.end(), 0);
  return FindIntersections(soup, all, 0.1, [](std::size_t, std::size_t) { return true; }).size();
}

void ThreadsFor(
  std::size_t count, const std::function<void(std::size_t begin, std::size_t end)>& body)
{
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < 3; ++i)
  {
    threads.emplace_back([&, i] { body(count * i / 3, count * (i + 1) / 3); });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
}

}

TEST(FitSurface, FindsTheFacesOfANoisyBox)
{
  ContourMesh mesh = BoxMesh();
  AddNoise(mesh.points, 0.008);
  const double before = RootMeanSquare(mesh.points);
  FitSurface(mesh.points, mesh.triangles, FeaturesOnBox(0.01), {});
  EXPECT_GT(before, 0.006);
  EXPECT_LT(RootMeanSquare(mesh.points), 0.25 * before);
  EXPECT_EQ(TopologyFaults(mesh), "");
  EXPECT_EQ(Intersections(mesh.points, mesh.triangles), 0u);
}

TEST(FitSurface, MovesAFaceThatIsBiased)
{
  ContourMesh mesh = BoxMesh();
  for (Vector3d& p : mesh.points)
  {
    p *= 1.02; // a bias of 0.012, a sixth of an edge
  }
  FitSurface(mesh.points, mesh.triangles, FeaturesOnBox(0.005), {});
  EXPECT_LT(RootMeanSquare(mesh.points), 0.002);
}

TEST(FitSurface, KeepsSharpEdges)
{
  ContourMesh mesh = BoxMesh();
  const ContourMesh before = mesh;
  AddNoise(mesh.points, 0.005);
  FitSurface(mesh.points, mesh.triangles, FeaturesOnBox(0.005), {});
  double sum = 0;
  int edges = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
  {
    const Vector3d from = before.points[v].cwiseAbs();
    for (int axis = 0; axis < 3; ++axis)
    {
      if ((from.array() > Half - 1e-3).count() >= 2 && from[axis] > Half - 1e-3)
      {
        sum += std::pow(std::abs(mesh.points[v][axis]) - Half, 2);
        ++edges;
      }
    }
  }
  EXPECT_EQ(edges, 12 * 15 * 2 + 8 * 3);
  EXPECT_LT(std::sqrt(sum / edges), 0.003);
}

TEST(FitSurface, OutliersCountLittle)
{
  ContourMesh mesh = BoxMesh();
  std::vector<SeenFeature> features = FeaturesOnBox(0.002);
  for (std::size_t i = 0; i < features.size(); i += 5)
  {
    features[i].point -= 0.003 * features[i].sight; // 15 deviations towards the camera
  }
  FitSurface(mesh.points, mesh.triangles, features, {});
  EXPECT_LT(RootMeanSquare(mesh.points), 0.003);
}

// Half of the features are biased by a deviation that they admit to.
TEST(FitSurface, DeviationsWeighFeatures)
{
  const auto residual = [](double deviation)
  {
    ContourMesh mesh = BoxMesh();
    std::vector<SeenFeature> features = FeaturesOnBox(0.001);
    for (std::size_t i = 0; i < features.size(); ++i)
    {
      const bool isBiased = i / 6 % 2 == 1;
      features[i].point *= isBiased ? 1.02 : 1;
      features[i].deviation = isBiased ? deviation : 0.001;
    }
    FitSurface(mesh.points, mesh.triangles, features, {});
    return RootMeanSquare(mesh.points);
  };
  EXPECT_GT(residual(0.001), 0.003);
  EXPECT_LT(residual(0.005), 0.001);
}

TEST(FitSurface, WithoutFeaturesIsSmoothedInPlace)
{
  ContourMesh mesh = BoxMesh();
  AddNoise(mesh.points, 0.008);
  const double before = RootMeanSquare(mesh.points);
  FitSurface(mesh.points, mesh.triangles, {}, {});
  EXPECT_LT(RootMeanSquare(mesh.points), 0.6 * before);
}

TEST(FitSurface, IsTheSameForAnyThreads)
{
  ContourMesh one = BoxMesh(), three = one;
  const std::vector<SeenFeature> features = FeaturesOnBox(0.01);
  FitSurface(one.points, one.triangles, features, {});
  FitSurface(three.points, three.triangles, features, {}, {}, ThreadsFor);
  EXPECT_EQ(one.points, three.points);
}

TEST(FitSurface, MovesNoVertexTooFar)
{
  ContourMesh mesh = BoxMesh();
  const std::vector<Vector3d> before = mesh.points;
  FitSurfaceOptions options;
  options.mostMove = 0.01;
  std::vector<SeenFeature> features = FeaturesOnBox(0);
  for (SeenFeature& feature : features)
  {
    feature.point += 0.002 * feature.sight;
  }
  FitSurface(mesh.points, mesh.triangles, features, options);
  double furthest = 0;
  for (std::size_t v = 0; v < before.size(); ++v)
  {
    furthest = std::max(furthest, (mesh.points[v] - before[v]).norm());
  }
  EXPECT_GT(furthest, 1e-4);
  EXPECT_LT(furthest, 0.01 * 2 * Half / 16 * 1.5);
}

TEST(FitSurface, NoTrianglesAndNoRoundsChangeNothing)
{
  std::vector<Vector3d> none;
  FitSurface(none, {}, FeaturesOnBox(0), {});
  ContourMesh mesh = BoxMesh();
  const std::vector<Vector3d> before = mesh.points;
  FitSurfaceOptions options;
  options.rounds = 0;
  FitSurface(mesh.points, mesh.triangles, FeaturesOnBox(0.01), options);
  EXPECT_EQ(mesh.points, before);
}

TEST(FitSurface, RefusesOptionsOutOfRange)
{
  for (double FitSurfaceOptions::*field :
    { &FitSurfaceOptions::waviness, &FitSurfaceOptions::reach, &FitSurfaceOptions::mostMove })
  {
    for (const double value : { 0.0, -1.0, double(NAN) })
    {
      FitSurfaceOptions options;
      options.*field = value;
      EXPECT_THROW(options.Check(), Error);
    }
  }
  FitSurfaceOptions options;
  options.rounds = -1;
  EXPECT_THROW(options.Check(), Error);
  NormalFilterOptions normals;
  normals.deviation = 0;
  EXPECT_THROW(normals.Check(), Error);
}

TEST(Untangle, TakesBackWhatMeetsItself)
{
  ContourMesh mesh = BoxMesh();
  const std::vector<Vector3d> before = mesh.points;
  AddNoise(mesh.points, 0.05);
  ASSERT_GT(Intersections(mesh.points, mesh.triangles), 0u);
  UntangleOptions options;
  options.cell = 0.1;
  Untangle(mesh.points, before, mesh.triangles, options);
  EXPECT_EQ(Intersections(mesh.points, mesh.triangles), 0u);
  EXPECT_NE(mesh.points, before);
}

TEST(TriangleGrid, FindsTheNearestFacingTriangleAsBruteForceDoes)
{
  const ContourMesh mesh = BoxMesh(6);
  const TriangleGrid grid(mesh.points, mesh.triangles, 0.3);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1, 1);
  int found = 0;
  for (int i = 0; i < 300; ++i)
  {
    const Vector3d point(place(random), place(random), place(random));
    const Vector3d direction(place(random), place(random), place(random));
    constexpr double reach = 0.4;
    double least = reach;
    for (const auto& [a, b, c] : mesh.triangles)
    {
      const Vector3d &p = mesh.points[a], &q = mesh.points[b], &r = mesh.points[c];
      if (direction.dot((q - p).cross(r - p)) < 0)
      {
        const Vector3d w = NearestOnTriangle(point, p, q, r);
        EXPECT_NEAR(w.sum(), 1, 1e-9);
        least = std::min(least, (w[0] * p + w[1] * q + w[2] * r - point).norm());
      }
    }
    const TrianglePlace nearest = grid.Nearest(point, direction, reach);
    EXPECT_EQ(nearest.triangle >= 0, least < reach);
    if (nearest.triangle >= 0)
    {
      ++found;
      const auto& [a, b, c] = mesh.triangles[nearest.triangle];
      const Vector3d& w = nearest.weights;
      EXPECT_NEAR(
        (w[0] * mesh.points[a] + w[1] * mesh.points[b] + w[2] * mesh.points[c] - point).norm(),
        least, 1e-12);
    }
  }
  EXPECT_GT(found, 50);
}

TEST(VertexSystem, SolvesAsDenseLeastSquaresDo)
{
  const std::vector<std::array<std::int32_t, 3>> triangles = { { 0, 1, 2 }, { 2, 1, 3 } };
  const MeshEdges edges(triangles, 4);
  ASSERT_EQ(edges.ends.size(), 5u);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<VertexSystem::Basis> bases(4);
  std::vector<int> offset = { 0 };
  for (int v = 0; v < 4; ++v)
  {
    bases[v].freedom = 1 + v % 3;
    const Eigen::Matrix3d any = Eigen::Matrix3d::NullaryExpr([&] { return number(random); });
    const Eigen::Matrix3d q = Eigen::HouseholderQR<Eigen::Matrix3d>(any).householderQ();
    bases[v].directions.leftCols(bases[v].freedom) = q.leftCols(bases[v].freedom);
    offset.push_back(offset.back() + bases[v].freedom);
  }
  constexpr double anchor = 0.1;
  VertexSystem system(bases, edges, anchor);
  const int size = offset.back();
  Eigen::MatrixXd H = anchor * Eigen::MatrixXd::Identity(size, size);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(size);
  const auto add = [&](const std::vector<std::pair<int, double>>& mix, const Vector3d& normal,
                     double residual, double weight)
  {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(size);
    for (const auto& [v, share] : mix)
    {
      for (int k = 0; k < bases[v].freedom; ++k)
      {
        row[offset[v] + k] += share * bases[v].directions.col(k).dot(normal);
      }
    }
    H += weight * row * row.transpose();
    g -= weight * residual * row;
  };
  for (int e = 0; e < 5; ++e)
  {
    const Vector3d normal(number(random), number(random), number(random));
    const double residual = number(random), weight = 1 + number(random);
    system.AddDifference(e, normal, residual, weight);
    add({ { edges.ends[e][0], 1 }, { edges.ends[e][1], -1 } }, normal, residual, weight);
  }
  for (int t = 0; t < 2; ++t)
  {
    const Vector3d normal(number(random), number(random), number(random)), mix(0.2, 0.5, 0.3);
    const double residual = number(random), weight = 1 + number(random);
    system.AddPlace(triangles[t], edges.ofTriangle[t], mix, normal, residual, weight);
    add({ { triangles[t][0], 0.2 }, { triangles[t][1], 0.5 }, { triangles[t][2], 0.3 } }, normal,
      residual, weight);
  }
  const Eigen::VectorXd expected = H.ldlt().solve(g);
  const std::vector<Vector3d> moves = system.Solve(1e-12, 100, SerialFor);
  for (int v = 0; v < 4; ++v)
  {
    Vector3d move = Vector3d::Zero();
    for (int k = 0; k < bases[v].freedom; ++k)
    {
      move += expected[offset[v] + k] * bases[v].directions.col(k);
    }
    EXPECT_LT((moves[v] - move).norm(), 1e-9);
  }
}

TEST(MeshEdges, KnowsWhatIsBesideATriangle)
{
  const MeshEdges edges({ { 0, 1, 2 }, { 2, 1, 3 }, { 4, 5, 6 } }, 7);
  EXPECT_EQ(edges.ends.size(), 8u);
  EXPECT_EQ(edges.opposite[0], (std::array<std::int32_t, 3>{ -1, 1, -1 }));
  EXPECT_EQ(edges.opposite[1], (std::array<std::int32_t, 3>{ 0, -1, -1 }));
  EXPECT_EQ(edges.opposite[2], (std::array<std::int32_t, 3>{ -1, -1, -1 }));
  EXPECT_EQ(edges.ofTriangle[0][1], edges.ofTriangle[1][0]);
}
