// SPDX-License-Identifier: BSD-3-Clause
#include "Images/ImageMask.h"

#include "Common/Error.h"
#include "Support/TemporaryFolder.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <gtest/gtest.h>

using namespace freespace;

TEST(ImageMask, IsScaledOrRefused)
{
  const TemporaryFolder folder;
  cv::Mat mask(60, 80, CV_8U, cv::Scalar(255));
  mask(cv::Rect(0, 0, 40, 60)) = 0;
  cv::imwrite(folder.Path("a.jpg.png"), mask);
  EXPECT_EQ(cv::countNonZero(LoadMask(folder.Path("a.jpg.png"), 80, 60)), 40 * 60);
  EXPECT_EQ(cv::countNonZero(LoadMask(folder.Path("a.jpg.png"), 160, 120)), 80 * 120);
  EXPECT_THROW(LoadMask(folder.Path("a.jpg.png"), 80, 80), Error);
  EXPECT_TRUE(LoadMask(folder.Path("missing.png"), 80, 60).empty());
  EXPECT_THROW(LoadMask(folder.Write("text.png", "no image"), 80, 60), Error);
}
