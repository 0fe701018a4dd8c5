// SPDX-License-Identifier: BSD-3-Clause
#include "Common/Error.h"
#include "Texture/DisparityImage.h"
#include "Texture/VisibilityMap.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

using namespace freespace;

namespace
{

Camera SmallCamera()
{
  Camera camera;
  camera.width = 40;
  camera.height = 30;
  camera.K << 35, 0, 19, 0, 36, 16, 0, 0, 1;
  camera.R = Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, -2, 0.5).normalized()).matrix();
  camera.t = { 0.1, -0.2, 0.3 };
  return camera;
}

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

void AddTriangle(
  TriangleMesh& mesh, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  const int first = static_cast<int>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), { a, b, c });
  mesh.triangles.push_back({ first, first + 1, first + 2 });
}

// A square parallel to the image, given by pixels.
void AddSquare(TriangleMesh& mesh, const Camera& camera, double left, double right, double depth)
{
  const auto at = [&](double u, double v) { return camera.Unproject({ u, v }, depth); };
  AddTriangle(mesh, at(left, -500), at(right, -500), at(right, 500));
  AddTriangle(mesh, at(left, -500), at(right, 500), at(left, 500));
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

TEST(VisibilityMap, FarSideOfAnOcclusionIsMasked)
{
  const Camera camera = SmallCamera();
  TriangleMesh mesh;
  AddSquare(mesh, camera, -500, 500, 4.0);
  AddSquare(mesh, camera, -500, 20.3, 2.0);
  VisibilityOptions options;
  options.feather = 4;
  const VisibilityMap map = MakeVisibilityMap(mesh, camera, options);
  EXPECT_GT(map.At({ 12, 15 }, 2.0), 0.9) << "the near square";
  EXPECT_EQ(map.At({ 12, 15 }, 4.0), 0.0) << "hidden behind it";
  EXPECT_GT(map.At({ 20.4, 15 }, 4.0), 0.0) << "beside its edge, but";
  EXPECT_LE(map.At({ 20.4, 15 }, 4.0), MaskedConfidence) << "masked";
  EXPECT_GT(map.At({ 23.5, 15 }, 4.0), 0.1) << "three pixels beside";
  EXPECT_GT(map.At({ 28, 15 }, 4.0), 0.9) << "far beside";
  EXPECT_GT(map.At({ 19.5, 15 }, 2.0), 0.0) << "the near square's rim is still seen";
  EXPECT_LT(map.At({ 19.5, 15 }, 2.0), 0.5);
}

TEST(VisibilityMap, MaskedPixelsTakeTheColourOfTheirSide)
{
  const Camera camera = SmallCamera();
  TriangleMesh mesh;
  AddSquare(mesh, camera, -500, 500, 4.0);
  AddSquare(mesh, camera, -500, 20.3, 2.0);
  VisibilityOptions options;
  options.jump = 2;
  const VisibilityMap map = MakeVisibilityMap(mesh, camera, options);
  Photograph photograph; // the near square is red and stains two pixels of the grey far one
  photograph.camera = camera;
  for (int i = 0; i < 40 * 30; ++i)
  {
    const unsigned char red = i % 40 < 22 ? 250 : 90;
    const unsigned char other = i % 40 < 22 ? 0 : 90;
    photograph.rgb.insert(photograph.rgb.end(), { red, other, other });
  }
  FillMasked(map, photograph);
  for (int column = 1; column < 39; ++column)
  {
    EXPECT_EQ(photograph.rgb[3 * (15 * 40 + column)], column < 20 ? 250 : 90) << column;
  }
}

TEST(VisibilityMap, SteepPlaneIsNoOcclusion)
{
  const Camera camera = SmallCamera();
  TriangleMesh mesh; // depth 1 at the left border, 20 at the right one
  AddTriangle(mesh, camera.Unproject({ 0, -200 }, 1), camera.Unproject({ 40, -200 }, 20),
    camera.Unproject({ 40, 230 }, 20));
  AddTriangle(mesh, camera.Unproject({ 0, -200 }, 1), camera.Unproject({ 40, 230 }, 20),
    camera.Unproject({ 0, 230 }, 1));
  VisibilityOptions options;
  options.feather = 2;
  const VisibilityMap map = MakeVisibilityMap(mesh, camera, options);
  for (int column = 3; column < 37; ++column)
  {
    const double depth = 1 / (1 + (column + 0.25) / 40 * (1.0 / 20 - 1));
    EXPECT_EQ(map.At({ column + 0.25, 15.3 }, depth), 1.0) << column;
  }
}

TEST(VisibilityMap, NothingIsSeenBeyondTheImageOrBehindTheCamera)
{
  const Camera camera = SmallCamera();
  TriangleMesh mesh;
  AddSquare(mesh, camera, -500, 500, 4.0);
  const VisibilityMap map = MakeVisibilityMap(mesh, camera);
  EXPECT_EQ(map.At({ -1, 15 }, 4.0), 0.0);
  EXPECT_EQ(map.At({ 41, 15 }, 4.0), 0.0);
  EXPECT_EQ(map.At({ 20, 31 }, 4.0), 0.0);
  EXPECT_EQ(map.At({ 20, 15 }, -4.0), 0.0);
}

TEST(VisibilityMap, RefusesOptionsOutOfRange)
{
  VisibilityOptions options;
  options.feather = 0;
  EXPECT_THROW(MakeVisibilityMap({}, SmallCamera(), options), Error);
}
