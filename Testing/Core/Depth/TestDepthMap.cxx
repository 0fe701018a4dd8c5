// SPDX-License-Identifier: BSD-3-Clause
#include "Depth/DepthMap.h"

#include "Common/Error.h"
#include "Support/DepthMapBytes.h"
#include "Support/TemporaryFolder.h"
#include "Support/Core/ErrorOf.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

using namespace freespace;

namespace
{

const std::vector<float> depths = { 1, 2, 3, 4.5F, 0, 6 };

void ExpectDepthMapError(const std::string& name, const std::string& bytes, const std::string& word)
{
  TemporaryFolder folder;
  SCOPED_TRACE(name);
  ExpectError([&] { ReadDepthMap(folder.Write(name, bytes)); }, { name, word });
}

void ExpectTheMap(const DepthMap& map)
{
  EXPECT_EQ(map.width, 3);
  EXPECT_EQ(map.height, 2);
  EXPECT_EQ(map.depths, depths);
  EXPECT_EQ(map.At(2, 0), 3);
  EXPECT_EQ(map.At(0, 1), 4.5F);
}

}

TEST(DepthMap, Colmap)
{
  TemporaryFolder folder;
  ExpectTheMap(ReadDepthMap(folder.Write("a.jpg.geometric.bin", ColmapDepthBytes(3, 2, depths))));
}

TEST(DepthMap, PfmOfBothOrders)
{
  for (const bool isBigEndian : { false, true })
  {
    TemporaryFolder folder;
    ExpectTheMap(ReadDepthMap(folder.Write("a.pfm", PfmBytes(3, 2, depths, isBigEndian))));
  }
}

TEST(DepthMap, PngOf16Bits)
{
  TemporaryFolder folder;
  cv::Mat pixels(2, 3, CV_16UC1);
  const std::uint16_t values[] = { 1, 256, 65535, 0, 7, 1000 };
  std::copy(values, values + 6, pixels.ptr<std::uint16_t>());
  cv::imwrite(folder.Path("a.png"), pixels);
  const DepthMap map = ReadDepthMap(folder.Path("a.png"));
  EXPECT_EQ(map.width, 3);
  EXPECT_EQ(map.depths, std::vector<float>(values, values + 6));
}

TEST(DepthMap, Malformed)
{
  const std::string colmap = ColmapDepthBytes(3, 2, depths), pfm = PfmBytes(3, 2, depths, false);
  ExpectDepthMapError("a.bin", "", "header");
  ExpectDepthMapError("a.bin", "3&2&3&" + colmap.substr(6), "one channel");
  ExpectDepthMapError("a.bin", "0&2&1&", "width and height");
  ExpectDepthMapError("a.bin", "-3&2&1&", "width and height");
  ExpectDepthMapError("a.bin", "60000&60000&1&", "truncated");
  ExpectDepthMapError("a.bin", colmap + "x", "more");
  ExpectDepthMapError("a.pfm", "", "header");
  ExpectDepthMapError("a.pfm", "PF" + pfm.substr(2), "three channels");
  ExpectDepthMapError("a.pfm", "Pf 3 2 0 ", "scale");
  ExpectDepthMapError("a.pfm", "Pf 3 2 nan ", "scale");
  ExpectDepthMapError("a.png", "hello", "no PNG");
  ExpectDepthMapError("a.exr", "hello", ".pfm");
  for (std::size_t length = 0; length < colmap.size(); ++length)
  {
    ExpectDepthMapError("a.bin", colmap.substr(0, length), "Cannot read");
  }
  for (std::size_t length = 0; length < pfm.size(); ++length)
  {
    ExpectDepthMapError("a.pfm", pfm.substr(0, length), "Cannot read");
  }
  TemporaryFolder folder;
  cv::imwrite(folder.Path("a.png"), cv::Mat(2, 3, CV_8UC1, cv::Scalar(1)));
  EXPECT_THROW(ReadDepthMap(folder.Path("a.png")), Error);
  EXPECT_THROW(ReadDepthMap(folder.Path("absent.png")), Error);
  EXPECT_THROW(ReadDepthMap(folder.Path("absent.bin")), Error);
}

TEST(DepthMap, NamesOfImages)
{
  EXPECT_EQ(ImageNameOfDepthMap("maps/a.jpg.geometric.bin"), "a.jpg");
  EXPECT_EQ(ImageNameOfDepthMap("a.jpg.photometric.bin"), "a.jpg");
  EXPECT_EQ(ImageNameOfDepthMap("a.b.pfm"), "a.b");
  EXPECT_EQ(ImageNameOfDepthMap("x/a.png"), "a");
}
