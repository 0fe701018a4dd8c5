// SPDX-License-Identifier: BSD-3-Clause
#include "Depth/DepthFeatures.h"

#include "Common/Error.h"
#include "Disparity/DelaunayDisparity.h"
#include "Support/LensFormulas.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <random>

using namespace freespace;

namespace
{

CalibratedImage ImageOf(const SparseCamera& camera)
{
  SparseImage image;
  image.name = "a.jpg";
  const Eigen::Quaterniond q(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  image.rotation = { q.w(), q.x(), q.y(), q.z() };
  image.translation = { 0.3, -0.2, 0.5 };
  return CalibratedImageOf(image, camera);
}

SparseCamera SmallCamera()
{
  return { 1, LensModel::Pinhole, 40, 30, { 40, 41, 20.5, 14 } };
}

DepthOptions EachPixel()
{
  DepthOptions options;
  options.largestBlock = 1;
  return options;
}

template <typename Depth>
DepthMap MapOf(int width, int height, const Depth& depth)
{
  DepthMap map{ width, height, {} };
  for (int row = 0; row < height; ++row)
  {
    for (int column = 0; column < width; ++column)
    {
      map.depths.push_back(static_cast<float>(depth(column, row)));
    }
  }
  return map;
}

}

TEST(DepthFeatures, EachPixelIsThePointThatTheCameraSees)
{
  const CalibratedImage image = ImageOf(SmallCamera());
  std::mt19937 random(3);
  std::uniform_real_distribution<double> depth(1, 9);
  const DepthMap map = MapOf(40, 30, [&](int, int) { return depth(random); });
  DepthOptions options = EachPixel();
  options.scale = 0.5;
  options.deviation = 0.01;
  const View view = FeaturesOfDepthMap(image, map, options);
  ASSERT_EQ(view.points.size(), 1200u);
  EXPECT_EQ(view.name, "a.jpg");
  EXPECT_EQ(view.imageFile, "a.jpg");
  for (std::size_t i = 0; i < view.points.size(); ++i)
  {
    const Eigen::Vector2d pixel(i % 40 + 0.5, i / 40 + 0.5);
    EXPECT_LT((view.imagePoints[i] - pixel).norm(), 1e-12);
    EXPECT_LT((image.camera.Project(view.points[i]) - pixel).norm(), 1e-9);
    const double z = 0.5 * map.depths[i];
    EXPECT_NEAR(image.camera.Depth(view.points[i]), z, 1e-12 * z);
    EXPECT_NEAR(view.deviations[i], (0.01 + 0.005 * z) / (z * z), 1e-12);
  }
}

TEST(DepthFeatures, RangesAreDistancesFromTheCentre)
{
  const CalibratedImage image = ImageOf(SmallCamera());
  DepthOptions options = EachPixel();
  options.isRange = true;
  const View view = FeaturesOfDepthMap(image, MapOf(40, 30, [](int, int) { return 3; }), options);
  for (const Eigen::Vector3d& point : view.points)
  {
    EXPECT_NEAR((point - image.camera.Center()).norm(), 3, 1e-12);
  }
}

// A map of half the size is of the same rays, and the lens's distortion is taken off.
TEST(DepthFeatures, SmallerMapsOfDistortedImages)
{
  for (const LensModel lens : { LensModel::OpenCV, LensModel::OpenCVFisheye })
  {
    const SparseCamera camera = CameraWithLens(lens);
    const CalibratedImage image = ImageOf(camera);
    const View view =
      FeaturesOfDepthMap(image, MapOf(40, 30, [](int, int) { return 2; }), EachPixel());
    ASSERT_EQ(view.points.size(), 1200u);
    for (std::size_t i = 0; i < view.points.size(); ++i)
    {
      const Eigen::Vector2d pixel(20 * (i % 40 + 0.5), 20 * (i / 40 + 0.5));
      const Eigen::Vector3d point = image.camera.FromWorld(view.points[i]);
      EXPECT_LT((ShowByFormula(camera, point) - pixel).norm(), 1e-5);
      EXPECT_NEAR(point.z(), 2, 1e-12);
    }
  }
}

TEST(DepthFeatures, PixelsWithoutADepthAreNone)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const DepthMap map{ 2, 3, { 0, 1, -1, nan, infinity, 5 } };
  const CalibratedImage image = ImageOf({ 1, LensModel::Pinhole, 2, 3, { 5, 5, 1, 1.5 } });
  EXPECT_EQ(FeaturesOfDepthMap(image, map, DepthOptions()).points.size(), 2u);
  DepthOptions options;
  options.nearest = 2;
  EXPECT_EQ(FeaturesOfDepthMap(image, map, options).points.size(), 1u);
  options.farthest = 4;
  EXPECT_TRUE(FeaturesOfDepthMap(image, map, options).points.empty());
}

TEST(DepthFeatures, OnePixel)
{
  const CalibratedImage image = ImageOf({ 1, LensModel::Pinhole, 1, 1, { 1, 1, 0.5, 0.5 } });
  EXPECT_EQ(FeaturesOfDepthMap(image, { 1, 1, { 2 } }, DepthOptions()).points.size(), 1u);
}

// The corners of its blocks stand for a plane, whose disparity is affine.
TEST(DepthFeatures, PlanesNeedFewFeatures)
{
  const CalibratedImage image = ImageOf({ 1, LensModel::Pinhole, 65, 49, { 60, 60, 32, 24 } });
  const auto plane = [](int column, int row) { return 1 / (0.2 + 0.002 * column + 0.001 * row); };
  const View view = FeaturesOfDepthMap(image, MapOf(65, 49, plane), DepthOptions());
  EXPECT_EQ(view.points.size(), 5u * 4u);
  DepthMap map = MapOf(65, 49, plane);
  map.depths[20 * 65 + 30] *= 1.1F; // a bump of one pixel in a block
  const View bumped = FeaturesOfDepthMap(image, map, DepthOptions());
  EXPECT_GT(bumped.points.size(), 20u);
  EXPECT_LT(bumped.points.size(), 60u);
  map.depths[20 * 65 + 30] = 0; // a hole of one pixel
  const View holed = FeaturesOfDepthMap(image, map, DepthOptions());
  const auto isBeside = [&](int column, int row)
  {
    return std::any_of(holed.imagePoints.begin(), holed.imagePoints.end(),
      [&](const Eigen::Vector2d& p) { return p == Eigen::Vector2d(column + 0.5, row + 0.5); });
  };
  EXPECT_TRUE(isBeside(29, 20) && isBeside(31, 20) && isBeside(30, 19) && isBeside(30, 21));
  EXPECT_FALSE(isBeside(30, 20));
}

namespace
{

// How many pixels there are in triangles, and of these off by more than so many deviations. By brute force.
std::pair<int, int> CoveredAndOff(
  const DisparityMap& triangulated, const DepthMap& map, const DepthOptions& options, double most)
{
  std::vector<Eigen::Matrix3d> inverses;
  std::vector<Eigen::Vector3d> disparities;
  for (const auto& triangle : triangulated.triangles)
  {
    Eigen::Matrix3d corners;
    Eigen::Vector3d disparity;
    for (int k = 0; k < 3; ++k)
    {
      corners.col(k) = triangulated.imagePoints[triangle[k]].homogeneous();
      disparity[k] = 1 / triangulated.camera.Depth(triangulated.points[triangle[k]]);
    }
    if (std::abs(corners.determinant()) > 1e-6) // points of the border are in line but for rounding
    {
      inverses.push_back(corners.inverse());
      disparities.push_back(disparity);
    }
  }
  int covered = 0, off = 0;
  for (int row = 0; row < map.height; ++row)
  {
    for (int column = 0; column < map.width; ++column)
    {
      for (std::size_t t = 0; t < inverses.size(); ++t)
      {
        const Eigen::Vector3d weights = inverses[t] * Eigen::Vector3d(column + 0.5, row + 0.5, 1);
        if (weights.minCoeff() > -1e-9)
        {
          const double depth = map.At(column, row);
          const double error = std::abs(1 / weights.dot(disparities[t]) - depth);
          ++covered;
          off += error > most * options.DeviationAt(depth);
          break;
        }
      }
    }
  }
  return { covered, off };
}

}

// What is left out is within the tolerance of the triangulated features, over random scenes of waves and a
// step. Where blocks of different sizes meet it may be twice that.
TEST(DepthFeatures, TheTriangulationIsWithinTheTolerance)
{
  for (unsigned int seed = 0; seed < 4; ++seed)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1, 1);
    const double a = any(random), b = any(random), step = any(random), wave = any(random);
    const DepthMap map = MapOf(49, 33,
      [&](int column, int row)
      {
        const double d =
          0.5 + 0.003 * a * column + 0.003 * b * row + 0.02 * wave * std::sin(column / 6.0);
        return 1 / (d + (column > 20 + row / 3 ? 0.1 * std::abs(step) : 0));
      });
    const CalibratedImage image =
      ImageOf({ 1, LensModel::Pinhole, 49, 33, { 50, 50, 24.5, 16.5 } });
    DepthOptions options;
    const View view = FeaturesOfDepthMap(image, map, options);
    EXPECT_LT(view.points.size(), 49u * 33u * 2 / 3) << "seed " << seed;
    const DisparityMap triangulated = TriangulateViews({ view }, {})[0];
    const auto [covered, off] = CoveredAndOff(triangulated, map, options, 2.01 * options.tolerance);
    EXPECT_EQ(covered, 49 * 33);
    EXPECT_EQ(off, 0) << "seed " << seed;
  }
}

TEST(DepthFeatures, OtherShapesAndOptionsAreRefused)
{
  const CalibratedImage image = ImageOf(SmallCamera());
  EXPECT_THROW(FeaturesOfDepthMap(image, MapOf(30, 40, [](int, int) { return 1; }), {}), Error);
  EXPECT_THROW(FeaturesOfDepthMap(image, {}, {}), Error);
  const DepthMap map = MapOf(40, 30, [](int, int) { return 1; });
  for (int fault = 0; fault < 7; ++fault)
  {
    DepthOptions options;
    options.scale = fault == 0 ? 0 : 1;
    options.nearest = fault == 1 ? -1 : fault == 2 ? 5 : 0;
    options.farthest = fault == 2 ? 4 : 0;
    options.relativeDeviation = fault == 3 ? 0 : 0.1;
    options.deviation = fault == 4 ? -1 : 0;
    options.tolerance = fault == 5 ? -1 : 1;
    options.largestBlock = fault == 6 ? 0 : 16;
    EXPECT_THROW(FeaturesOfDepthMap(image, map, options), Error) << fault;
  }
}

TEST(DepthFeatures, MapsFindTheirImages)
{
  std::vector<CalibratedImage> images(4);
  images[0].file = "one/a.jpg";
  images[1].file = "one/b.jpg";
  images[2].file = "two/b.jpg";
  images[3].file = "b.jpg";
  EXPECT_EQ(ImageOfDepthMap(images, "maps/a.jpg.geometric.bin"), 0u);
  EXPECT_EQ(ImageOfDepthMap(images, "maps/a.png"), 0u);
  EXPECT_EQ(ImageOfDepthMap(images, "maps/b.jpg.pfm"), 3u); // by its whole name
  EXPECT_THROW(ImageOfDepthMap(images, "maps/b.png"), Error);
  EXPECT_THROW(ImageOfDepthMap(images, "maps/c.png"), Error);
}
