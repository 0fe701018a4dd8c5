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

const std::string plyHeader = "element vertex 3\nproperty float x\nproperty float y\nproperty "
                              "float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                              "end_header\n";
const std::string plyText = "ply\nformat ascii 1.0\n" + plyHeader;
const std::string plyBinary = "ply\nformat binary_little_endian 1.0\n" + plyHeader;

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
  for (const Check check : { CheckWholeVTKFile, CheckWholePLY, CheckWholeSTL, CheckWholeJPEG })
  {
    EXPECT_THROW(check("/no/such/file"), Error);
    const TemporaryFolder folder;
    EXPECT_THROW(check(folder.Path()), Error);
  }
}

TEST(WholeFile, EmptyFile)
{
  EXPECT_FALSE(Passes(CheckWholeVTKFile, ""));
  EXPECT_FALSE(Passes(CheckWholePLY, ""));
  EXPECT_FALSE(Passes(CheckWholeSTL, ""));
  EXPECT_TRUE(Passes(CheckWholeJPEG, "")) << "no JPEG: left to the decoder";
}

TEST(WholeFile, VTKFileNeedsItsClosingTag)
{
  const std::string content = "<VTKFile><PolyData>" + std::string(500, ' ') + "</PolyData>";
  EXPECT_TRUE(Passes(CheckWholeVTKFile, content + "</VTKFile>\n"));
  EXPECT_FALSE(Passes(CheckWholeVTKFile, content));
  EXPECT_FALSE(Passes(CheckWholeVTKFile, content + "</VTKFile"));
}

TEST(WholeFile, TextPLYNeedsItsLines)
{
  EXPECT_TRUE(Passes(CheckWholePLY, plyText + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"));
  EXPECT_TRUE(Passes(CheckWholePLY, plyText + "0 0 0\n\n1 0 0\n0 1 0\n3 0 1 2"));
  EXPECT_FALSE(Passes(CheckWholePLY, plyText + "0 0 0\n1 0 0\n0 1 0\n"));
  EXPECT_FALSE(Passes(CheckWholePLY, plyText + "0 0 0\n\n\n\n1 0 0\n"));
}

TEST(WholeFile, BinaryPLYNeedsItsBytes)
{
  constexpr std::size_t body = 3 * 3 * 4 + 1 + 3 * 4;
  EXPECT_TRUE(Passes(CheckWholePLY, plyBinary + std::string(body, '\0')));
  EXPECT_TRUE(Passes(CheckWholePLY, plyBinary + std::string(body + 4, '\0'))) << "a quadrilateral";
  EXPECT_FALSE(Passes(CheckWholePLY, plyBinary + std::string(body - 1, '\0')));
}

TEST(WholeFile, PLYNeedsItsHeader)
{
  EXPECT_FALSE(Passes(CheckWholePLY, plyText.substr(0, plyText.size() - 12)));
  EXPECT_FALSE(Passes(CheckWholePLY, "solid\n" + plyText));
}

TEST(WholeFile, BinarySTLNeedsItsTriangles)
{
  std::string header(84, '\0');
  header[80] = 2;
  EXPECT_TRUE(Passes(CheckWholeSTL, header + std::string(100, '\0')));
  EXPECT_FALSE(Passes(CheckWholeSTL, header + std::string(99, '\0')));
  EXPECT_FALSE(Passes(CheckWholeSTL, header + std::string(50, '\0')));
  EXPECT_FALSE(Passes(CheckWholeSTL, header.substr(0, 83)));
}

TEST(WholeFile, TextSTLNeedsItsEnd)
{
  const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                            "vertex 0 1 0\nendloop\nendfacet\n";
  EXPECT_TRUE(Passes(CheckWholeSTL, "solid a\n" + facet + "endsolid a\n"));
  EXPECT_FALSE(Passes(CheckWholeSTL, "solid a\n" + facet));
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

TEST(WholeFile, OtherImagesPass)
{
  EXPECT_TRUE(Passes(CheckWholeJPEG, "\x89PNG\r\n"));
}
