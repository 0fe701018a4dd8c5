// SPDX-License-Identifier: BSD-3-Clause
#include "Text/WholeFile.h"

#include "Common/Error.h"
#include "Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <opencv2/imgcodecs.hpp>

using namespace freespace;

namespace
{

using Check = void (*)(const std::string&);

// Whether a check lets a file with this content pass.
bool Passes(Check check, const std::string& content)
{
  const TemporaryFolder folder;
  const std::string file = folder.Write("file", content);
  try
  {
    check(file);
    return true;
  }
  catch (const Error& error)
  {
    EXPECT_NE(std::string(error.what()).find(file), std::string::npos) << error.what();
    return false;
  }
}

std::string JPEGBytes(int height)
{
  std::vector<std::uint8_t> bytes;
  cv::Mat image(height, 17, CV_8UC3);
  cv::randu(image, 0, 256);
  cv::imencode(".jpg", image, bytes);
  return { bytes.begin(), bytes.end() };
}

}

TEST(WholeFile, MissingFileAndFolder)
{
  EXPECT_THROW(CheckWholeJPEG("/no/such/file"), Error);
  const TemporaryFolder folder;
  EXPECT_THROW(CheckWholeJPEG(folder.Path()), Error);
}

TEST(WholeFile, EmptyFile)
{
  EXPECT_TRUE(Passes(CheckWholeJPEG, "")) << "no JPEG: left to the decoder";
}

TEST(WholeFile, JPEGNeedsItsEndMarker)
{
  for (const int height : { 1, 13, 400 })
  {
    const std::string jpeg = JPEGBytes(height);
    EXPECT_TRUE(Passes(CheckWholeJPEG, jpeg)) << height;
    EXPECT_TRUE(Passes(CheckWholeJPEG, jpeg + "trailing bytes")) << height;
    EXPECT_FALSE(Passes(CheckWholeJPEG, jpeg.substr(0, jpeg.size() - 2))) << height;
    EXPECT_FALSE(Passes(CheckWholeJPEG, jpeg.substr(0, jpeg.size() / 2))) << height;
  }
}

TEST(WholeFile, JPEGThatLostASectorIsDamaged)
{
  std::string jpeg = JPEGBytes(400);
  ASSERT_GT(jpeg.size(), 8000u);
  jpeg.replace(jpeg.size() / 2, 2048, 2048, '\0');
  EXPECT_FALSE(Passes(CheckWholeJPEG, jpeg));
}

TEST(WholeFile, JPEGWithPaddingAfterItsScanIsWhole)
{
  std::string jpeg = JPEGBytes(40);
  jpeg.insert(jpeg.size() - 2, 10, '\0');
  EXPECT_TRUE(Passes(CheckWholeJPEG, jpeg));
}

TEST(WholeFile, OtherImagesPass)
{
  EXPECT_TRUE(Passes(CheckWholeJPEG, "\x89PNG\r\n"));
}
