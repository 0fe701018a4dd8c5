// SPDX-License-Identifier: BSD-3-Clause
#include "Patches/ImagePyramids.h"

#include "Support/Core/ErrorOf.h"
#include "Support/TemporaryFolder.h"

#include <opencv2/imgcodecs.hpp>

#include <gtest/gtest.h>

#include <filesystem>

using namespace freespace;

namespace
{

// Images of 40 x 30 pixels on disk.
class PyramidScene
{
public:
  PyramidScene()
  {
    std::filesystem::create_directories(this->Folder.Path("images"));
    std::filesystem::create_directories(this->Folder.Path("masks"));
    this->Source.file = this->Folder.Path("scene.json");
    this->Source.images = "images";
  }

  CalibratedImage Add(const std::string& name, const cv::Mat& pixels) const
  {
    cv::imwrite(this->Folder.Path("images/" + name), pixels);
    CalibratedImage image;
    image.file = name;
    image.camera.width = 40;
    image.camera.height = 30;
    image.camera.K << 50, 0, 20, 0, 50, 15, 0, 0, 1;
    return image;
  }

  TemporaryFolder Folder;
  Scene Source;
};

cv::Mat Plain(const cv::Vec3b& color)
{
  return cv::Mat(30, 40, CV_8UC3, cv::Scalar(color));
}

}

TEST(ImagePyramids, LevelsAreGreyAndHalveTheResolution)
{
  const PyramidScene scene;
  const CalibratedImage image = scene.Add("a.png", Plain({ 10, 100, 200 }));
  ImagePyramids pyramids(scene.Source);
  const auto pyramid = pyramids.Find(image);
  ASSERT_EQ(pyramid->levels.size(), 2u);
  EXPECT_EQ(pyramid->levels[0].size(), cv::Size(40, 30));
  EXPECT_EQ(pyramid->levels[1].size(), cv::Size(20, 15));
  EXPECT_EQ(pyramid->color(3, 4), cv::Vec3b(10, 100, 200));
  EXPECT_TRUE(pyramid->mask.empty());
  const double grey = 0.114 * 10 + 0.587 * 100 + 0.299 * 200;
  EXPECT_NEAR(pyramid->levels[0](29, 39), grey, 0.6);
  EXPECT_NEAR(pyramid->levels[1](0, 0), grey, 0.6);
}

// The smoothing and the halving keep the mean, and each pixel of the second level is that of four.
TEST(ImagePyramids, SmoothingAndHalvingKeepWhatIsThere)
{
  const PyramidScene scene;
  cv::Mat dot = Plain({ 0, 0, 0 });
  dot.at<cv::Vec3b>(14, 20) = { 255, 255, 255 };
  ImagePyramids pyramids(scene.Source);
  const auto pyramid = pyramids.Find(scene.Add("dot.png", dot));
  EXPECT_NEAR(cv::sum(pyramid->levels[0])[0], 255, 0.1);
  EXPECT_LT(pyramid->levels[0](14, 20), 120) << "it is spread";
  EXPECT_GT(pyramid->levels[0](14, 20), 50) << "but little";
  for (int row = 0; row < 15; ++row)
  {
    for (int column = 0; column < 20; ++column)
    {
      const cv::Mat four = pyramid->levels[0](cv::Rect(2 * column, 2 * row, 2, 2));
      EXPECT_NEAR(pyramid->levels[1](row, column), cv::mean(four)[0], 1e-3);
    }
  }
}

TEST(ImagePyramids, AnImageIsReadOnce)
{
  const PyramidScene scene;
  const CalibratedImage a = scene.Add("a.png", Plain({ 1, 1, 1 }));
  const CalibratedImage b = scene.Add("b.png", Plain({ 2, 2, 2 }));
  ImagePyramids pyramids(scene.Source);
  const auto first = pyramids.Find(a);
  EXPECT_NE(pyramids.Find(b), first);
  EXPECT_EQ(pyramids.Find(a), first);
  ImagePyramids small(scene.Source, 40 * 30);
  const auto kept = small.Find(a);
  small.Find(b);
  EXPECT_NE(small.Find(a), kept) << "there is room for one";
}

TEST(ImagePyramids, MasksGoWithTheirImage)
{
  PyramidScene scene;
  scene.Source.masks = "masks";
  const CalibratedImage a = scene.Add("a.png", Plain({ 9, 9, 9 }));
  cv::Mat mask(30, 40, CV_8U, cv::Scalar(255));
  mask(cv::Rect(0, 0, 10, 30)) = 0;
  cv::imwrite(scene.Folder.Path("masks/a.png.png"), mask);
  ImagePyramids pyramids(scene.Source);
  const auto pyramid = pyramids.Find(a);
  ASSERT_EQ(pyramid->mask.size(), cv::Size(40, 30));
  EXPECT_EQ(pyramid->mask(5, 9), 0);
  EXPECT_EQ(pyramid->mask(5, 10), 255);
  EXPECT_TRUE(pyramids.Find(scene.Add("b.png", Plain({ 9, 9, 9 })))->mask.empty());
}

TEST(ImagePyramids, FaultsNameTheFile)
{
  const PyramidScene scene;
  ImagePyramids pyramids(scene.Source);
  CalibratedImage missing = scene.Add("a.png", Plain({ 9, 9, 9 }));
  missing.file = "missing.png";
  ExpectError([&] { pyramids.Find(missing); }, { "missing.png" });
  CalibratedImage larger = scene.Add("a.png", Plain({ 9, 9, 9 }));
  larger.camera.width = 41;
  ExpectError([&] { pyramids.Find(larger); }, { "a.png", "41" });
}
