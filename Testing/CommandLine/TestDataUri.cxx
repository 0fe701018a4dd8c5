// SPDX-License-Identifier: BSD-3-Clause
#include "Report/Page/DataUri.h"

#include "Common/Error.h"
#include "Support/TemporaryFolder.h"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <fstream>

using namespace freespace;

TEST(Base64, IsThatOfTheStandard)
{
  const std::string text = "foobar"; // RFC 4648, section 10
  const char* expected[] = { "", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy" };
  for (std::size_t n = 0; n <= text.size(); ++n)
  {
    EXPECT_EQ(Base64(text.data(), n), expected[n]);
  }
  const unsigned char bytes[] = { 0xfb, 0xff, 0xfe };
  EXPECT_EQ(Base64(bytes, 3), "+//+");
  EXPECT_EQ(Base64(std::vector<std::uint16_t>{ 1, 256 }), "AQAAAQ==") << "little-endian";
}

TEST(InlinePicture, IsNoWiderThanAsked)
{
  const TemporaryFolder folder;
  const std::string file = folder.Path("picture.png");
  cv::imwrite(file, cv::Mat(30, 100, CV_8UC3, cv::Scalar(10, 20, 30)));
  const InlinePicture small = InlinePictureFromFile(file, 50);
  EXPECT_EQ(small.width, 50);
  EXPECT_EQ(small.height, 15);
  EXPECT_EQ(small.uri.rfind("data:image/jpeg;base64,/9j/", 0), 0u);
  EXPECT_EQ(InlinePictureFromFile(file, 200).width, 100) << "never enlarged";
}

TEST(InlinePicture, NamesTheFileThatIsNone)
{
  const TemporaryFolder folder;
  const std::string file = folder.Path("picture.png");
  std::ofstream(file) << "no picture";
  for (const std::string& name : { file, folder.Path("none.png") })
  {
    try
    {
      InlinePictureFromFile(name, 50);
      FAIL() << name;
    }
    catch (const Error& error)
    {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
}
