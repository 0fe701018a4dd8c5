// SPDX-License-Identifier: BSD-3-Clause
#include "Patches/PatchAligner.h"

#include "Support/SyntheticImages.h"

#include <opencv2/imgproc.hpp>

#include <gtest/gtest.h>

#include <random>

using namespace freespace;

namespace
{

// A smooth texture without an edge.
std::function<Eigen::Vector3d(double, double)> WavesImage()
{
  return [](double x, double y)
  {
    const double value = 128 + 30 * std::sin(140 * x + 40 * y) + 25 * std::sin(35 * x - 120 * y) +
      40 * std::sin(230 * x + 190 * y);
    return Eigen::Vector3d(value, value, value);
  };
}

// A plane, seen by a cross of cameras; a partner's grey levels may be brighter and of less contrast.
class AlignerScene
{
public:
  explicit AlignerScene(const Eigen::Vector2d& slope,
    const std::function<Eigen::Vector3d(double, double)>& color = WavesImage(), double gain = 1)
  {
    this->Plane.slope = slope;
    this->Plane.exists = Everywhere();
    this->Plane.color = color;
    for (const Camera& camera : CrossOfCameras())
    {
      cv::Mat grey, values;
      cv::cvtColor(Render({ this->Plane }, camera, nullptr, 9), grey, cv::COLOR_BGR2GRAY);
      const bool isReference = this->Images.empty();
      grey.convertTo(values, CV_32F, isReference ? 1 : gain, isReference ? 0 : 255 * (1 - gain));
      this->Images.push_back({ camera, values });
    }
  }

  double Disparity(const Eigen::Vector2d& pixel) const
  {
    const Camera& camera = this->Images[0].camera;
    return 1 / this->Plane.Meet(camera.Center(), camera.Ray(pixel));
  }

  PatchAligner Aligner(const PatchOptions& options = {}, int partners = 4) const
  {
    return PatchAligner(this->Images[0],
      { this->Images.begin() + 1, this->Images.begin() + 1 + partners }, 1, options);
  }

  Layer Plane;
  std::vector<PatchAligner::Image> Images;
};

PatchPlane FrontoParallel(const Eigen::Vector2d& pixel, double disparity)
{
  PatchPlane plane;
  plane.pixel = pixel;
  plane.disparity = disparity;
  return plane;
}

// From starts up to a pixel off, in disparity, without its slope.
void ExpectConvergence(const AlignerScene& scene)
{
  const PatchAligner aligner = scene.Aligner();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> column(40, 200), row(40, 140), off(-1, 1);
  int good = 0, close = 0, calibrated = 0;
  constexpr int count = 300;
  for (int i = 0; i < count; ++i)
  {
    const Eigen::Vector2d pixel(column(random), row(random));
    const double truth = scene.Disparity(pixel);
    const double perPixel = 1 / aligner.Parallax(FrontoParallel(pixel, truth));
    const AlignedPatch patch = aligner.Align(FrontoParallel(pixel, truth + off(random) * perPixel));
    if (patch.isGood)
    {
      const double error = std::abs(patch.plane.disparity - truth);
      ++good;
      close += error < 0.05 * perPixel;
      calibrated += error < 2 * patch.deviation;
      EXPECT_LT(error, 0.3 * perPixel);
      EXPECT_GE(patch.correlation, PatchOptions().leastCorrelation);
    }
  }
  EXPECT_GT(good, 0.9 * count);
  EXPECT_GT(close, 0.95 * good);
  EXPECT_GT(calibrated, 0.95 * good);
}

}

TEST(PatchAligner, FrontoParallelPlane)
{
  ExpectConvergence(AlignerScene({ 0, 0 }));
}

TEST(PatchAligner, SlantedPlanes)
{
  ExpectConvergence(AlignerScene({ 0.5, 0 }));
  ExpectConvergence(AlignerScene({ -0.2, 0.4 }));
}

TEST(PatchAligner, DoesNotCareForBrightnessAndContrast)
{
  ExpectConvergence(AlignerScene({ 0.2, 0.1 }, WavesImage(), 0.6));
}

TEST(PatchAligner, FindsTheSlope)
{
  const AlignerScene scene({ 0.4, -0.3 });
  const Eigen::Vector2d pixel(120, 90), right(121, 90), down(120, 91);
  const double truth = scene.Disparity(pixel);
  const AlignedPatch patch = scene.Aligner().Align(FrontoParallel(pixel, truth));
  ASSERT_TRUE(patch.isGood);
  EXPECT_NEAR(patch.plane.slope.x(), scene.Disparity(right) - truth, 2e-4);
  EXPECT_NEAR(patch.plane.slope.y(), scene.Disparity(down) - truth, 2e-4);
}

TEST(PatchAligner, ParallaxIsTheMovementInThePartner)
{
  const AlignerScene scene({ 0, 0 });
  const Eigen::Vector2d pixel(100, 80);
  const double disparity = 1, step = 1e-6;
  double most = 0;
  for (int k = 1; k < 5; ++k)
  {
    const auto project = [&](double d)
    { return scene.Images[k].camera.Project(scene.Images[0].camera.Unproject(pixel, 1 / d)); };
    most = std::max(most, (project(disparity + step) - project(disparity)).norm() / step);
  }
  EXPECT_NEAR(scene.Aligner().Parallax(FrontoParallel(pixel, disparity)), most, 1e-3 * most);
}

TEST(PatchAligner, NothingWithoutContrast)
{
  const AlignerScene scene({ 0, 0 }, Plain(90, 90, 90));
  EXPECT_FALSE(scene.Aligner().Align(FrontoParallel({ 120, 90 }, 1)).isGood);
}

// An edge at the window's rim tells nothing of its middle.
TEST(PatchAligner, NothingWhereOnlyTheRimHasContrast)
{
  const AlignerScene scene({ 0, 0 },
    [](double x, double)
    {
      const double value = x < 0 ? 60 : 180;
      return Eigen::Vector3d(value, value, value);
    });
  const double edge = scene.Images[0].camera.Project({ 0, 0, 1 }).x();
  EXPECT_FALSE(scene.Aligner().Align(FrontoParallel({ edge + 4, 90 }, 1)).isGood);
  EXPECT_TRUE(scene.Aligner().Align(FrontoParallel({ edge, 90 }, 1)).isGood);
}

TEST(PatchAligner, NothingAtTheImagesRim)
{
  const AlignerScene scene({ 0, 0 });
  for (const Eigen::Vector2d& pixel :
    { Eigen::Vector2d(2, 90), Eigen::Vector2d(120, 2), Eigen::Vector2d(238, 90),
      Eigen::Vector2d(120, 179.5), Eigen::Vector2d(-5, -5), Eigen::Vector2d(1e9, 90) })
  {
    EXPECT_FALSE(scene.Aligner().Align(FrontoParallel(pixel, 1)).isGood) << pixel.transpose();
  }
}

TEST(PatchAligner, NeedsTwoPartners)
{
  const AlignerScene scene({ 0, 0 });
  const PatchPlane plane = FrontoParallel({ 120, 90 }, 1);
  EXPECT_FALSE(scene.Aligner({}, 0).Align(plane).isGood);
  EXPECT_FALSE(scene.Aligner({}, 1).Align(plane).isGood);
  EXPECT_TRUE(scene.Aligner({}, 2).Align(plane).isGood);
}

TEST(PatchAligner, NothingFarFromTheSurface)
{
  const AlignerScene scene({ 0, 0 }, RandomSquares(0.01, 3));
  for (const double disparity : { 0.3, 0.6, 1.5, 3.0 })
  {
    EXPECT_FALSE(scene.Aligner().Align(FrontoParallel({ 120, 90 }, disparity)).isGood) << disparity;
  }
}
