// SPDX-License-Identifier: BSD-3-Clause
#include "Images/DecodeImage.h"

#include "Support/TemporaryFolder.h"

#include <opencv2/imgcodecs.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

using namespace freespace;

namespace
{

// A ramp of 256 greys, times a factor.
cv::Mat Ramp(int type, double factor)
{
  cv::Mat ramp(4, 256, CV_64FC1);
  for (int x = 0; x < 256; ++x)
  {
    ramp.col(x) = x * factor;
  }
  cv::Mat colors, image;
  cv::merge(std::vector<cv::Mat>{ ramp, ramp, ramp }, colors);
  colors.convertTo(image, type);
  return image;
}

void ExpectRamp(const cv::Mat& image, int channels, const char* what)
{
  ASSERT_EQ(image.type(), CV_MAKETYPE(CV_8U, channels)) << what;
  ASSERT_EQ(image.size(), cv::Size(256, 4)) << what;
  for (int x = 0; x < 256; ++x)
  {
    EXPECT_NEAR(image.ptr(1)[x * channels], x, 1) << what;
  }
}

}

TEST(DecodeImage, TheRangeOfTheNumbersIsBroughtToEightBits)
{
  ExpectRamp(EightBits(Ramp(CV_8U, 1)), 3, "8 bits");
  ExpectRamp(EightBits(Ramp(CV_16U, 4095 / 255.0)), 3, "12 bits in 16");
  ExpectRamp(EightBits(Ramp(CV_16U, 16383 / 255.0)), 3, "14 bits in 16");
  ExpectRamp(EightBits(Ramp(CV_16U, 257)), 3, "16 bits");
  ExpectRamp(EightBits(Ramp(CV_32F, 1 / 255.0)), 3, "0 to 1");
  ExpectRamp(EightBits(Ramp(CV_64F, 1)), 3, "0 to 255");
  ExpectRamp(EightBits(Ramp(CV_32F, 257)), 3, "0 to 65535");
}

TEST(DecodeImage, EightBitsStayAsTheyAre)
{
  const cv::Mat dark(2, 3, CV_8UC3, cv::Scalar(1, 2, 3));
  EXPECT_EQ(EightBits(dark).data, dark.data);
}

TEST(DecodeImage, WhatIsNoLightIsBlack)
{
  cv::Mat image = Ramp(CV_32F, 1 / 255.0);
  image.at<cv::Vec3f>(0, 0) = { -1.0f, std::numeric_limits<float>::quiet_NaN(),
    std::numeric_limits<float>::infinity() };
  const cv::Mat bytes = EightBits(image);
  EXPECT_EQ(bytes.at<cv::Vec3b>(0, 0), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(bytes.at<cv::Vec3b>(0, 255), cv::Vec3b(255, 255, 255));
}

TEST(DecodeImage, BrighterThanWhiteIsWhite)
{
  cv::Mat image = Ramp(CV_32F, 1 / 255.0);
  image.at<cv::Vec3f>(0, 7) = { 1.5f, 0.5f, 0.0f };
  EXPECT_EQ(EightBits(image).at<cv::Vec3b>(0, 7), cv::Vec3b(255, 128, 0));
}

TEST(DecodeImage, FilesOfEachDepth)
{
  const TemporaryFolder folder;
  const std::vector<int> exact = { cv::IMWRITE_TIFF_COMPRESSION, 1 }; // none
  const std::pair<const char*, cv::Mat> files[] = { { "8.png", Ramp(CV_8U, 1) },
    { "12.png", Ramp(CV_16U, 4095 / 255.0) }, { "12.tif", Ramp(CV_16U, 4095 / 255.0) },
    { "16.png", Ramp(CV_16U, 257) }, { "16.tif", Ramp(CV_16U, 257) }, { "8.tif", Ramp(CV_8U, 1) },
    { "float.tif", Ramp(CV_32F, 1 / 255.0) } };
  for (const auto& [name, image] : files)
  {
    ASSERT_TRUE(cv::imwrite(folder.Path(name), image, exact)) << name;
    ExpectRamp(DecodeImage(folder.Path(name), true), 3, name);
    ExpectRamp(DecodeImage(folder.Path(name), false), 1, name);
  }
  cv::Mat grey;
  cv::extractChannel(Ramp(CV_32F, 1 / 255.0), grey, 0);
  ASSERT_TRUE(cv::imwrite(folder.Path("grey.tif"), grey, exact));
  ExpectRamp(DecodeImage(folder.Path("grey.tif"), true), 3, "grey.tif");
  ExpectRamp(DecodeImage(folder.Path("grey.tif"), false), 1, "grey.tif");
}
