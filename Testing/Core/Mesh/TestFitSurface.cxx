// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Fit/FitSurface.h"

#include "Common/Error.h"
#include "Support/ContourFields.h"
#include "Support/Core/BoxMesh.h"
#include "Support/MeshTopology.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <random>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

double HeightOverBox(const Vector3d& p)
{
  return p.cwiseAbs().maxCoeff() - BoxHalf;
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
    p[axis] = side * BoxHalf + noise(random);
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
  EXPECT_EQ(CountIntersections(mesh.points, mesh.triangles), 0u);
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
      if ((from.array() > BoxHalf - 1e-3).count() >= 2 && from[axis] > BoxHalf - 1e-3)
      {
        sum += std::pow(std::abs(mesh.points[v][axis]) - BoxHalf, 2);
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

// BoxHalf of the features are biased by a deviation that they admit to.
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
  FitSurface(three.points, three.triangles, features, {}, {}, ThreeThreads);
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
  EXPECT_LT(furthest, 0.01 * 2 * BoxHalf / 16 * 1.5);
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
