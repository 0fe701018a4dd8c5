// SPDX-License-Identifier: BSD-3-Clause
#include "Texture/DisparityImage.h"

#include "Support/Core/SmallImage.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

using namespace freespace;

namespace
{

// 1 / depth of the nearest triangle on a ray, by brute force.
double CastRay(const TriangleMesh& mesh, const Camera& camera, const Eigen::Vector2d& pixel)
{
  double disparity = 0;
  for (const auto& [a, b, c] : mesh.triangles)
  {
    Eigen::Matrix3d system;
    system << mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a], -camera.Ray(pixel);
    const Eigen::Vector3d solution = system.inverse() * (camera.Center() - mesh.points[a]);
    if (solution.allFinite() && solution[0] >= 0 && solution[1] >= 0 &&
      solution[0] + solution[1] <= 1 && solution[2] > 0)
    {
      disparity = std::max(disparity, 1 / solution[2]);
    }
  }
  return disparity;
}

}

TEST(DisparityImage, AgreesWithRayCasting)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const Camera camera = SmallCamera();
  for (int repeat = 0; repeat < 20; ++repeat)
  {
    TriangleMesh mesh;
    for (int i = 0; i < 12; ++i)
    {
      std::array<Eigen::Vector3d, 3> corners;
      for (Eigen::Vector3d& corner : corners)
      {
        corner = Eigen::Vector3d(unit(random), unit(random), unit(random)) * 4; // some behind
      }
      AddTriangle(mesh, corners[0], corners[1], corners[2]);
    }
    const DisparityImage image = RenderDisparity(mesh, camera);
    int differing = 0;
    for (int row = 0; row < camera.height; ++row)
    {
      for (int column = 0; column < camera.width; ++column)
      {
        const double expected = CastRay(mesh, camera, { column + 0.5, row + 0.5 });
        // The near plane cuts off what is nearer than 1e-4 of the farthest point.
        const bool same = std::abs(image.At(column, row) - expected) <= 1e-5 * (1 + expected);
        differing += !same && expected < 500;
      }
    }
    EXPECT_LE(differing, 2) << "beyond what rounding does to pixels on an edge";
  }
}

TEST(DisparityImage, EmptyMeshIsSeenNowhere)
{
  const DisparityImage image = RenderDisparity({}, SmallCamera());
  EXPECT_EQ(image.values, std::vector<float>(40 * 30, 0.0f));
}

TEST(DisparityImage, LeavesOutWhatIsNotFiniteOrHasNoArea)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Camera camera = SmallCamera();
  TriangleMesh mesh;
  const Eigen::Vector3d seen = camera.Unproject({ 20, 15 }, 2.0);
  AddTriangle(mesh, seen, seen, seen);
  AddTriangle(mesh, seen, seen + Eigen::Vector3d(nan, 0, 0), camera.Unproject({ 5, 5 }, 2.0));
  AddTriangle(mesh, camera.Unproject({ 0, 0 }, 2), camera.Unproject({ 10, 10 }, 2),
    camera.Unproject({ 20, 20 }, 2)); // collinear
  const DisparityImage image = RenderDisparity(mesh, camera);
  for (const float value : image.values)
  {
    EXPECT_TRUE(value == 0 || std::abs(value - 0.5f) < 1e-3f) << value;
  }
}
