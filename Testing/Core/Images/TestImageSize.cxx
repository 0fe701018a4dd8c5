// SPDX-License-Identifier: BSD-3-Clause
#include "Images/ImageSize.h"

#include "Support/TemporaryFolder.h"

#include <opencv2/imgcodecs.hpp>

#include <gtest/gtest.h>

#include <string>

using namespace freespace;

TEST(ImageSize, IsReadFromHeaders)
{
  const TemporaryFolder folder;
  for (const std::string name : { "a.jpg", "a.png", "a.bmp", "a.tif" })
  {
    cv::imwrite(folder.Path(name), cv::Mat(300, 37, CV_8UC3, { 9, 9, 9 }));
    const auto size = ReadImageSize(folder.Path(name));
    ASSERT_TRUE(size) << name;
    EXPECT_EQ((*size)[0], 37) << name;
    EXPECT_EQ((*size)[1], 300) << name;
  }
}

TEST(ImageSize, OfWhatIsNoImageIsNotKnown)
{
  const TemporaryFolder folder;
  EXPECT_FALSE(ReadImageSize(folder.Path("missing.png")));
  EXPECT_FALSE(ReadImageSize(folder.Write("empty.jpg", "")));
  EXPECT_FALSE(ReadImageSize(folder.Write("text.png", "no image")));
  EXPECT_FALSE(ReadImageSize(folder.Write("cut.png", "\x89PNG\r\n\x1a\n")));
  EXPECT_FALSE(ReadImageSize(folder.Write("cut.jpg", "\xff\xd8\xff\xe0")));
}
