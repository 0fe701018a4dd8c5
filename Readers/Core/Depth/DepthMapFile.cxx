// SPDX-License-Identifier: BSD-3-Clause
#include "Depth/DepthMap.h"

#include "Common/Error.h"
#include "Common/ParseNumber.h"
#include "Images/ImageCodecs.h"
#include "Text/TextSource.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string_view>

#include <opencv2/imgcodecs.hpp>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

constexpr int mostPixels = 1 << 16; // along a side

// Reads the header of a file and then its numbers.
class DepthSource
{
public:
  explicit DepthSource(const std::string& file)
    : File(file)
    , Content(ReadWholeFile(file))
  {
  }

  [[noreturn]] void Fail(const std::string& fault) const
  {
    throw Error("Cannot read the depth map " + this->File + ": " + fault + ".");
  }

  // The text before the next of these characters, which is skipped.
  std::string_view Until(const char* ends)
  {
    constexpr std::size_t most = 64;
    const std::string_view rest = std::string_view(this->Content).substr(this->Position);
    const std::size_t end = rest.substr(0, most).find_first_of(ends);
    if (end == std::string_view::npos)
    {
      this->Fail("its header is not that of a depth map");
    }
    this->Position += end + 1;
    return rest.substr(0, end);
  }

  int Size(std::string_view text) const
  {
    const auto size = ParseNumber<int>(text);
    if (!size || *size < 1 || *size > mostPixels)
    {
      this->Fail("its width and height are not usable");
    }
    return *size;
  }

  std::vector<float> Floats(int width, int height, bool swap) const
  {
    const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (this->Content.size() - this->Position != count * sizeof(float))
    {
      this->Fail(this->Content.size() - this->Position < count * sizeof(float)
          ? "it is truncated"
          : "it holds more than its size says");
    }
    std::vector<float> depths(count);
    const char* from = this->Content.data() + this->Position;
    for (float& depth : depths)
    {
      char bytes[sizeof(float)];
      std::memcpy(bytes, from, sizeof(float));
      if (swap)
      {
        std::reverse(bytes, bytes + sizeof(float));
      }
      std::memcpy(&depth, bytes, sizeof(float));
      from += sizeof(float);
    }
    return depths;
  }

private:
  std::string File;
  std::string Content;
  std::size_t Position = 0;
};

// "width&height&channels&", then floats, row by row.
DepthMap ReadColmapMap(const std::string& file)
{
  DepthSource source(file);
  DepthMap map;
  map.width = source.Size(source.Until("&"));
  map.height = source.Size(source.Until("&"));
  if (source.Until("&") != "1")
  {
    source.Fail("it has not one channel: it is a map of normals or of consistency");
  }
  map.depths = source.Floats(map.width, map.height, false);
  return map;
}

// "Pf", width and height, a scale whose sign tells the order of bytes; the bottom row first.
DepthMap ReadPfm(const std::string& file)
{
  constexpr const char* blanks = " \n\r\t";
  DepthSource source(file);
  DepthMap map;
  if (const std::string_view kind = source.Until(blanks); kind != "Pf")
  {
    source.Fail(kind == "PF" ? "it has three channels, not one" : "it does not begin with Pf");
  }
  map.width = source.Size(source.Until(blanks));
  map.height = source.Size(source.Until(blanks));
  const auto scale = ParseNumber<double>(source.Until(blanks));
  if (!scale || *scale == 0 || !std::isfinite(*scale))
  {
    source.Fail("its scale is not usable");
  }
  map.depths = source.Floats(map.width, map.height, *scale > 0);
  for (int row = 0; row < map.height / 2; ++row)
  {
    std::swap_ranges(map.depths.begin() + static_cast<std::ptrdiff_t>(row) * map.width,
      map.depths.begin() + static_cast<std::ptrdiff_t>(row + 1) * map.width,
      map.depths.end() - static_cast<std::ptrdiff_t>(row + 1) * map.width);
  }
  return map;
}

DepthMap ReadPng(const std::string& file)
{
  std::string content = ReadWholeFile(file);
  const auto fail = [&](const char* fault)
  { throw Error("Cannot read the depth map " + file + ": " + fault + "."); };
  cv::Mat pixels;
  try
  {
    pixels = DecodeImageBytes(
      cv::Mat(1, static_cast<int>(content.size()), CV_8UC1, content.data()), cv::IMREAD_UNCHANGED);
  }
  catch (const cv::Exception&)
  {
    fail("it is damaged");
  }
  if (pixels.empty())
  {
    fail("it is no PNG or damaged");
  }
  if (pixels.type() != CV_16UC1)
  {
    fail("it has not 16 bits and one channel");
  }
  DepthMap map;
  map.width = pixels.cols;
  map.height = pixels.rows;
  map.depths.reserve(pixels.total());
  for (int row = 0; row < pixels.rows; ++row)
  {
    const auto* begin = pixels.ptr<std::uint16_t>(row);
    map.depths.insert(map.depths.end(), begin, begin + pixels.cols);
  }
  return map;
}

}

DepthMap ReadDepthMap(const std::string& file)
{
  const std::string ending = fs::path(file).extension().string();
  if (ending == ".bin")
  {
    return ReadColmapMap(file);
  }
  if (ending == ".pfm")
  {
    return ReadPfm(file);
  }
  if (ending == ".png")
  {
    return ReadPng(file);
  }
  throw Error("Cannot read the depth map " + file + ": its name ends in none of .bin .pfm .png.");
}

std::string ImageNameOfDepthMap(const std::string& file)
{
  fs::path name = fs::path(file).filename().replace_extension();
  for (const char* ending : { ".geometric", ".photometric" })
  {
    if (name.extension() == ending)
    {
      name.replace_extension();
    }
  }
  return name.string();
}

}
