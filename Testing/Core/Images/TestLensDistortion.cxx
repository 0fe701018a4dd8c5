// SPDX-License-Identifier: BSD-3-Clause
#include "Images/LensDistortion.h"

#include "Images/UndistortedImage.h"
#include "Support/LensFormulas.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include <random>

using namespace freespace;

namespace
{

CalibratedImage ImageWith(const SparseCamera& camera)
{
  SparseImage image;
  image.name = "a.jpg";
  return CalibratedImageOf(image, camera);
}

bool IsFisheye(LensModel model)
{
  return ImageWith(CameraWithLens(model)).lens != LensKind::Perspective;
}

// Rays up to this angle from the axis, all around.
std::vector<Eigen::Vector3d> RaysUpTo(double degrees, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> angle(0, degrees * M_PI / 180), turn(0, 2 * M_PI);
  std::vector<Eigen::Vector3d> rays;
  for (int i = 0; i < 500; ++i)
  {
    const double theta = angle(random), phi = turn(random);
    rays.emplace_back(
      std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
  }
  rays.emplace_back(0, 0, 1); // the axis itself
  return rays;
}

}

TEST(LensDistortion, IsThatOfThePublishedFormulas)
{
  for (const LensModel model : everyLensModel)
  {
    const SparseCamera camera = CameraWithLens(model);
    const CalibratedImage image = ImageWith(camera);
    for (const Eigen::Vector3d& ray : RaysUpTo(IsFisheye(model) ? 79 : 40, 1))
    {
      const Eigen::Vector2d pinhole = (image.camera.K * ray).hnormalized();
      const Eigen::Vector2d shown = DistortPixels(image, { pinhole })[0];
      EXPECT_LT((shown - ShowByFormula(camera, ray)).norm(), 1e-9) << LensModelName(model);
    }
  }
}

TEST(LensDistortion, UndistortedAgain)
{
  for (const LensModel model : everyLensModel)
  {
    const SparseCamera camera = CameraWithLens(model);
    const CalibratedImage image = ImageWith(camera);
    for (const Eigen::Vector3d& ray : RaysUpTo(IsFisheye(model) ? 79 : 40, 2))
    {
      const Eigen::Vector2d pinhole = (image.camera.K * ray).hnormalized();
      const Eigen::Vector2d again = UndistortPixels(image, { ShowByFormula(camera, ray) })[0];
      EXPECT_LT((again - pinhole).norm(), 1e-7 * (1 + pinhole.norm())) << LensModelName(model);
    }
  }
}

TEST(LensDistortion, WhatNoPinholeCameraSees)
{
  for (const LensModel model : everyLensModel)
  {
    if (!IsFisheye(model))
    {
      continue;
    }
    const SparseCamera camera = CameraWithLens(model);
    const CalibratedImage image = ImageWith(camera);
    for (const double degrees : { 81.0, 88.0 })
    {
      const double angle = degrees * M_PI / 180;
      const Eigen::Vector2d shown = ShowByFormula(camera, { std::sin(angle), 0, std::cos(angle) });
      EXPECT_FALSE(UndistortPixels(image, { shown })[0].allFinite())
        << LensModelName(model) << " at " << degrees;
    }
    EXPECT_FALSE(UndistortPixels(image, { { 1e5, 300 } })[0].allFinite()) << LensModelName(model);
  }
}

// FOV with a field of view of 0 is a pinhole camera, which its formula cannot tell.
TEST(LensDistortion, FieldOfViewThatIsNearlyNone)
{
  for (const double omega : { 0.0, 1e-9, 1e-5 })
  {
    const CalibratedImage image =
      ImageWith({ 1, LensModel::FieldOfView, 800, 600, { 400, 400, 400, 300, omega } });
    for (const Eigen::Vector2d& pixel : { Eigen::Vector2d(10, 20), Eigen::Vector2d(400, 300) })
    {
      EXPECT_LT((DistortPixels(image, { pixel })[0] - pixel).norm(), 1e-6) << omega;
      EXPECT_LT((UndistortPixels(image, { pixel })[0] - pixel).norm(), 1e-6) << omega;
    }
  }
}

TEST(LensDistortion, NoPixels)
{
  EXPECT_TRUE(UndistortPixels(ImageWith(CameraWithLens(LensModel::OpenCVFisheye)), {}).empty());
  EXPECT_TRUE(DistortPixels(ImageWith(CameraWithLens(LensModel::FieldOfView)), {}).empty());
}

// An image of a ramp, as the lens shows it, is the ramp again.
TEST(LensDistortion, ImagesAreResampledByTheFormula)
{
  for (const LensModel model : { LensModel::OpenCVFisheye, LensModel::ThinPrismFisheye,
         LensModel::FieldOfView, LensModel::Radial })
  {
    SparseCamera camera = CameraWithLens(model);
    camera.width = 80;
    camera.height = 60;
    for (std::size_t i = 0; i < 2 + FocalLengths(model); ++i)
    {
      camera.parameters[i] /= 10;
    }
    const CalibratedImage image = ImageWith(camera);
    cv::Mat shown(60, 80, CV_32FC1);
    for (int row = 0; row < 60; ++row)
    {
      for (int column = 0; column < 80; ++column)
      {
        const Eigen::Vector2d seen = UndistortPixels(image, { { column + 0.5, row + 0.5 } })[0];
        shown.at<float>(row, column) = static_cast<float>(seen.x() + 2 * seen.y());
      }
    }
    const cv::Mat ideal = Undistorted(shown, image, cv::INTER_LINEAR);
    for (int row = 20; row < 40; ++row)
    {
      for (int column = 30; column < 50; ++column)
      {
        EXPECT_NEAR(ideal.at<float>(row, column), column + 0.5 + 2 * (row + 0.5), 0.1)
          << LensModelName(model);
      }
    }
  }
}
