// SPDX-License-Identifier: BSD-3-Clause
#include "Surface/SurfaceFile.h"

#include "Common/Error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <cstring>
#include <random>

using namespace freespace;

namespace
{

using ParseSurface = SurfaceFile (*)(const std::string&, const std::string&);

std::string SurfaceFaultOf(ParseSurface parse, const std::string& content)
{
  try
  {
    parse(content, "mesh.file");
  }
  catch (const Error& error)
  {
    EXPECT_NE(std::string(error.what()).find("mesh.file"), std::string::npos) << error.what();
    return error.what();
  }
  return "";
}

bool Has(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

template <typename Value>
void Append(std::string& bytes, Value value, bool isBigEndian = false)
{
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if (isBigEndian)
  {
    std::reverse(raw, raw + sizeof value);
  }
  bytes.append(raw, sizeof value);
}

const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string plyText = "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 3\n"
                            "property float x\nproperty float y\nproperty float z\n" +
  faces;
const std::string corners = "0 0 0\n1.5 0 0\n0 1 0\n";

// A tetrahedron's triangle of doubles with colours and a list that nobody reads.
std::string BinaryPLY(bool isBigEndian)
{
  std::string bytes = std::string("ply\nformat binary_") + (isBigEndian ? "big" : "little") +
    "_endian 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty list uchar short n\n" +
    faces;
  for (int i = 0; i < 3; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      Append(bytes, 500000.1 + i * (axis + 1), isBigEndian);
    }
    bytes += { char(10 * i), 2, 3 };
    bytes += char(1);
    Append(bytes, std::int16_t(7), isBigEndian);
  }
  bytes += char(3);
  for (std::int32_t corner : { 2, 1, 0 })
  {
    Append(bytes, corner, isBigEndian);
  }
  return bytes;
}

std::string BinarySTL(std::uint32_t triangles)
{
  std::string bytes(80, ' ');
  Append(bytes, triangles);
  for (std::uint32_t t = 0; t < triangles; ++t)
  {
    for (float value : { 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, float(t) })
    {
      Append(bytes, value);
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

}

TEST(SurfaceFile, TextPLY)
{
  const SurfaceFile surface = ParsePLY(plyText + corners + "3 0 1 2\n", "");
  ASSERT_EQ(surface.points.size(), 3u);
  EXPECT_EQ(surface.points[1][0], 1.5);
  EXPECT_EQ(surface.corners, (std::vector<std::int64_t>{ 0, 1, 2 }));
  EXPECT_EQ(surface.comments, std::vector<std::string>{ "made by hand" });
  EXPECT_FALSE(surface.isDouble);
}

TEST(SurfaceFile, BinaryPLYOfBothOrders)
{
  for (const bool isBigEndian : { false, true })
  {
    const SurfaceFile surface = ParsePLY(BinaryPLY(isBigEndian), "");
    ASSERT_EQ(surface.points.size(), 3u);
    EXPECT_EQ(surface.points[2][1], 500004.1) << "in double precision";
    EXPECT_TRUE(surface.isDouble);
    EXPECT_EQ(surface.corners, (std::vector<std::int64_t>{ 2, 1, 0 }));
    EXPECT_EQ(surface.colors[2], (std::array<std::uint8_t, 3>{ 20, 2, 3 }));
  }
}

TEST(SurfaceFile, NumbersDoNotDependOnTheLocale)
{
  if (!std::setlocale(LC_NUMERIC, "de_DE.UTF-8"))
  {
    GTEST_SKIP() << "there is no locale with a decimal comma";
  }
  EXPECT_EQ(ParsePLY(plyText + corners + "3 0 1 2\n", "").points[1][0], 1.5);
  EXPECT_EQ(ParseOBJ("v 0 0 0\nv 1.5 0 0\nv 0 1 0\nf 1 2 3\n", "").points[1][0], 1.5);
  std::setlocale(LC_NUMERIC, "C");
}

TEST(SurfaceFile, PLYIndicesOutOfRange)
{
  for (const char* face : { "3 0 1 3", "3 0 1 -1", "3 0 1 99999999", "3 0 1 1e18", "3 0 1 0.5" })
  {
    EXPECT_TRUE(Has(SurfaceFaultOf(ParsePLY, plyText + corners + face), "none of the 3 points"))
      << face;
  }
  EXPECT_TRUE(Has(SurfaceFaultOf(ParsePLY, plyText + corners + "2 0 1"), "fewer than three"));
  EXPECT_TRUE(Has(SurfaceFaultOf(ParsePLY, plyText + corners + "255 0 1 2"), "truncated"));
  EXPECT_TRUE(Has(SurfaceFaultOf(ParsePLY, plyText + corners + "-3 0 1 2"), "truncated"));
}

TEST(SurfaceFile, PLYThatCountsMoreThanItHolds)
{
  std::string most = plyText;
  most.replace(most.find("vertex 3"), 8, "vertex 18446744073709551615");
  EXPECT_TRUE(Has(SurfaceFaultOf(ParsePLY, most + corners + "3 0 1 2\n"), "truncated"));
  EXPECT_TRUE(
    Has(SurfaceFaultOf(ParsePLY, "ply\nformat ascii 1.0\nelement face 4000000000\nend_header\n"),
      "truncated"))
    << "of no bytes each";
}

TEST(SurfaceFile, PLYHeaders)
{
  for (const std::string& content : { std::string(), std::string("plywood\n"),
         std::string("ply\nformat ascii 1.0\n"), plyText.substr(0, plyText.size() - 12) })
  {
    EXPECT_TRUE(Has(SurfaceFaultOf(ParsePLY, content), "truncated")) << content;
  }
  EXPECT_TRUE(
    Has(SurfaceFaultOf(ParsePLY, "ply\nformat ebcdic 1.0\nend_header\n"), "no format 'ebcdic'"));
  EXPECT_TRUE(
    Has(SurfaceFaultOf(ParsePLY, "ply\nproperty float x\nend_header\n"), "of no element"));
  EXPECT_TRUE(
    Has(SurfaceFaultOf(ParsePLY, "ply\nelement face 1\nproperty list float int i\nend_header\n"),
      "no whole number"));
  EXPECT_TRUE(Has(SurfaceFaultOf(ParsePLY,
                    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n"),
    "no y"));
}

TEST(SurfaceFile, OBJ)
{
  const SurfaceFile surface = ParseOBJ("# a comment\nv 0 0 0\nv 1e6 0 0.1\nv 0 1 0 1\nvt 0 0\n"
                                       "f 1/1/1 2//2 3/1\nf -3 -2 -1\n",
    "");
  EXPECT_EQ(surface.points[1][2], 0.1);
  EXPECT_EQ(surface.corners, (std::vector<std::int64_t>{ 0, 1, 2, 0, 1, 2 }));
}

TEST(SurfaceFile, OBJIndicesOutOfRange)
{
  for (const char* face : { "0 0 0", "1 2 4", "1 2 -4", "1 2 x", "1 2 99999999999999999999" })
  {
    const std::string content = std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nf ") + face;
    EXPECT_TRUE(Has(SurfaceFaultOf(ParseOBJ, content), "none of the 3 points")) << face;
  }
  EXPECT_TRUE(Has(SurfaceFaultOf(ParseOBJ, "v 0 0\n"), "truncated"));
  EXPECT_TRUE(Has(SurfaceFaultOf(ParseOBJ, "v 0 0 zero\n"), "'zero'"));
  EXPECT_TRUE(Has(SurfaceFaultOf(ParseOBJ, std::string("v\0v\n", 4)), "not text"));
}

TEST(SurfaceFile, BinarySTL)
{
  const SurfaceFile surface = ParseSTL(BinarySTL(2), "");
  EXPECT_EQ(surface.points.size(), 4u) << "equal corners are one point";
  EXPECT_EQ(surface.ends, (std::vector<std::int64_t>{ 3, 6 }));
  EXPECT_TRUE(Has(SurfaceFaultOf(ParseSTL, BinarySTL(2).substr(0, 180)), "truncated"));
  EXPECT_TRUE(Has(SurfaceFaultOf(ParseSTL, BinarySTL(2).substr(0, 83)), "truncated"));
  EXPECT_TRUE(Has(SurfaceFaultOf(ParseSTL, ""), "truncated"));
}

TEST(SurfaceFile, TextSTL)
{
  const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                            "vertex 0 1 0.5\nendloop\nendfacet\n";
  EXPECT_EQ(ParseSTL("solid a\n" + facet + "endsolid a\n", "").points.size(), 3u);
  EXPECT_TRUE(Has(SurfaceFaultOf(ParseSTL, "solid a\n" + facet), "truncated"));
  EXPECT_TRUE(Has(SurfaceFaultOf(ParseSTL, "solid a\nvertex 0 0 0\nendsolid"), "truncated"));
}

// Whatever a damaged file says, it ends in a surface whose corners are points, or in an Error.
TEST(SurfaceFile, DamagedFiles)
{
  const std::pair<ParseSurface, std::string> seeds[] = {
    { ParsePLY, plyText + corners + "3 0 1 2\n" }, { ParsePLY, BinaryPLY(false) },
    { ParseOBJ, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" }, { ParseSTL, BinarySTL(3) },
    { ParseSTL, "solid\nvertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endsolid" }
  };
  std::mt19937 random(1);
  int read = 0;
  for (int run = 0; run < 20000; ++run)
  {
    auto [parse, content] = seeds[run % std::size(seeds)];
    for (int change = 0; change < 3; ++change)
    {
      content[random() % content.size()] = static_cast<char>(random());
    }
    try
    {
      const SurfaceFile surface = parse(content, "");
      ++read;
      for (std::int64_t corner : surface.corners)
      {
        ASSERT_TRUE(corner >= 0 && corner < static_cast<std::int64_t>(surface.points.size()));
      }
    }
    catch (const Error&)
    {
    }
  }
  EXPECT_GT(read, 100);
}
