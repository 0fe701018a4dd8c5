// SPDX-License-Identifier: BSD-3-Clause
// Patches of a slanted plane without an edge, whose disparity is known at each pixel.
#include "Patches/PatchStereo.h"

#include "Common/Error.h"
#include "Support/SyntheticImages.h"
#include "Support/TemporaryFolder.h"

#include <opencv2/imgcodecs.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace freespace;
using Eigen::Vector2d;

namespace
{

constexpr double PixelsPerDisparity =
  40; // of CrossOfCameras: baselines of 0.1, a focal length of 400

Eigen::Vector3d Waves(double x, double y)
{
  const double value = 128 + 30 * std::sin(140 * x + 40 * y) + 25 * std::sin(35 * x - 120 * y) +
    40 * std::sin(230 * x + 190 * y);
  return { value / 2, value, value };
}

// The plane as a cross of images in memory, and features of it every 24 pixels.
class PlaneScene
{
public:
  explicit PlaneScene(const std::function<Eigen::Vector3d(double, double)>& color)
  {
    this->Plane.slope = { 0.3, -0.2 };
    this->Plane.exists = Everywhere();
    this->Plane.color = color;
    std::map<std::string, cv::Mat> pixels;
    for (const Camera& camera : CrossOfCameras())
    {
      CalibratedImage& image = this->Images.emplace_back();
      image.file = std::to_string(this->Images.size()) + ".png";
      image.camera = camera;
      pixels[image.file] = Render({ this->Plane }, camera, nullptr, 9);
    }
    this->Source.file = "in memory";
    this->Source.pixels = std::make_shared<const std::map<std::string, cv::Mat>>(std::move(pixels));
    this->Features.name = "cross";
    this->Features.camera = this->Images[0].camera;
    for (double row = 10; row < 180; row += 24)
    {
      for (double column = 10; column < 240; column += 24)
      {
        this->AddFeature({ column, row }, this->Disparity({ column, row }));
      }
    }
  }

  double Disparity(const Vector2d& pixel) const
  {
    const Camera& camera = this->Images[0].camera;
    return 1 / this->Plane.Meet(camera.Center(), camera.Ray(pixel));
  }

  void AddFeature(const Vector2d& pixel, double disparity)
  {
    this->Features.imagePoints.push_back(pixel);
    this->Features.points.push_back(this->Features.camera.Unproject(pixel, 1 / disparity));
  }

  std::vector<PatchFeature> Find(
    const std::vector<Vector2d>& seeds = {}, const CancellationFlag& stop = NeverCancelled) const
  {
    ImagePyramids images(this->Source);
    return FindPatches(this->Features, seeds, this->Images[0],
      { this->Images.begin() + 1, this->Images.end() }, images, this->Options, stop);
  }

  Layer Plane;
  Scene Source;
  std::vector<CalibratedImage> Images;
  View Features;
  PatchOptions Options;
};

// Rendered once.
PlaneScene WavyScene()
{
  static const PlaneScene scene(Waves);
  return scene;
}

}

TEST(PatchStereo, PatchesLieOnThePlane)
{
  const PlaneScene scene = WavyScene();
  const std::vector<PatchFeature> found = scene.Find();
  ASSERT_GT(found.size(), 400u); // of 30 by 40 places on the grid, those near the border left out
  int close = 0, calibrated = 0;
  for (const PatchFeature& patch : found)
  {
    const double error = patch.disparity - scene.Disparity(patch.imagePoint);
    EXPECT_LT(std::abs(error) * PixelsPerDisparity, 0.5) << patch.imagePoint.transpose();
    close += std::abs(error) * PixelsPerDisparity < 0.1;
    calibrated += std::abs(error) < 4 * patch.deviation;
    EXPECT_GT(patch.deviation, 0);
    EXPECT_GE(patch.cost, 0);
    EXPECT_LE(patch.cost, 1 - scene.Options.leastCorrelation);
    EXPECT_NEAR(patch.color[0], 2 * patch.color[2], 3) << "red, green, blue";
    EXPECT_EQ(patch.color[0], patch.color[1]);
  }
  EXPECT_GT(close, 0.95 * found.size());
  EXPECT_GT(calibrated, 0.9 * found.size());
}

TEST(PatchStereo, TheGridLeavesOutWhatHasFeatures)
{
  PlaneScene scene = WavyScene();
  const std::vector<Vector2d> seeds = { { 100.3, 80.6 }, { 61.5, 90.5 } };
  const std::vector<PatchFeature> found = scene.Find(seeds);
  ASSERT_GT(found.size(), 2u);
  EXPECT_EQ(found[0].imagePoint, seeds[0]) << "the seeds come first, in their order";
  EXPECT_EQ(found[1].imagePoint, seeds[1]);
  std::vector<Vector2d> known = scene.Features.imagePoints;
  known.insert(known.end(), seeds.begin(), seeds.end());
  Vector2d last(0, 0);
  for (std::size_t i = 2; i < found.size(); ++i)
  {
    const Vector2d place = found[i].imagePoint;
    EXPECT_EQ(std::fmod(place.x() - 3.5, 6), 0) << place.transpose();
    EXPECT_EQ(std::fmod(place.y() - 3.5, 6), 0) << place.transpose();
    EXPECT_TRUE(place.y() > last.y() || (place.y() == last.y() && place.x() > last.x()));
    last = place;
    for (const Vector2d& feature : known)
    {
      EXPECT_GT((place.array().floor() - feature.array().floor()).abs().maxCoeff(), 3)
        << place.transpose();
    }
  }
}

TEST(PatchStereo, AWallWithoutTextureHasNone)
{
  EXPECT_TRUE(PlaneScene(Plain(90, 120, 130)).Find({ { 100.5, 80.5 } }).empty());
}

// Features that lie a few pixels of disparity off their plane, this way and that, tell nothing of what is
// between them.
TEST(PatchStereo, BetweenRoughFeaturesThereAreNone)
{
  PlaneScene scene = WavyScene();
  const std::vector<Vector2d> places = scene.Features.imagePoints;
  scene.Features.imagePoints.clear();
  scene.Features.points.clear();
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    scene.AddFeature(places[i], scene.Disparity(places[i]) + (i % 2 ? 8 : -8) / PixelsPerDisparity);
  }
  EXPECT_LT(scene.Find().size(), 40u);
}

TEST(PatchStereo, NothingIsFoundWhereTheMaskIsBlack)
{
  const TemporaryFolder folder;
  PlaneScene scene = WavyScene();
  cv::Mat1b mask(180, 240, static_cast<unsigned char>(255));
  mask.colRange(0, 120) = 0;
  cv::imwrite(folder.Path(scene.Images[0].file + ".png"), mask);
  scene.Source.file = folder.Path("scene.json");
  scene.Source.masks = ".";
  const std::vector<PatchFeature> found = scene.Find();
  EXPECT_GT(found.size(), 150u);
  EXPECT_TRUE(std::all_of(found.begin(), found.end(),
    [](const PatchFeature& patch) { return patch.imagePoint.x() > 120; }));
}

TEST(PatchStereo, TooFewFeaturesAreAnErrorThatNamesTheView)
{
  PlaneScene scene = WavyScene();
  scene.Features.imagePoints.resize(2);
  scene.Features.points.resize(2);
  try
  {
    scene.Find();
    FAIL() << "no error";
  }
  catch (const Error& error)
  {
    EXPECT_NE(std::string(error.what()).find("cross"), std::string::npos) << error.what();
  }
}

TEST(PatchStereo, OptionsAreChecked)
{
  PlaneScene scene = WavyScene();
  scene.Options.spacing = 0;
  EXPECT_THROW(scene.Find(), Error);
}

TEST(PatchStereo, CanBeCancelled)
{
  const CancellationFlag stop{ true };
  EXPECT_THROW(WavyScene().Find({}, stop), Aborted);
}
