// SPDX-License-Identifier: BSD-3-Clause
#include "Files/PathChecks.h"
#include "Images/ImageSize.h"

#include "Images/ImageCodecs.h"

#include <opencv2/imgcodecs.hpp>

#include <cstdint>
#include <filesystem>
#include <fstream>

namespace freespace
{

namespace
{

using Size = std::optional<std::array<int, 2>>;

// The next bytes as a number, the highest first; -1 at the end.
std::int64_t Number(std::istream& file, int bytes)
{
  std::int64_t number = 0;
  for (int i = 0; i < bytes; ++i)
  {
    const int byte = file.get();
    if (byte == std::char_traits<char>::eof())
    {
      return -1;
    }
    number = number * 256 + byte;
  }
  return number;
}

Size SizeOf(std::int64_t width, std::int64_t height)
{
  constexpr std::int64_t most = 1 << 20;
  return width > 0 && height > 0 && width < most && height < most
    ? Size({ static_cast<int>(width), static_cast<int>(height) })
    : std::nullopt;
}

// Behind the signature: length and name of the first chunk, then the size.
Size SizeOfPng(std::istream& file)
{
  constexpr std::int64_t header = 0x49484452; // IHDR
  file.seekg(12);
  if (Number(file, 4) != header)
  {
    return std::nullopt;
  }
  const std::int64_t width = Number(file, 4);
  return SizeOf(width, Number(file, 4));
}

// In the segment that begins the frame: C0 to CF but for the tables C4, C8 and CC.
Size SizeOfJpeg(std::istream& file)
{
  file.seekg(2);
  while (Number(file, 1) == 0xff)
  {
    std::int64_t marker = Number(file, 1);
    while (marker == 0xff) // padding
    {
      marker = Number(file, 1);
    }
    const std::int64_t length = Number(file, 2);
    if (length < 2)
    {
      return std::nullopt;
    }
    if (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc)
    {
      file.seekg(1, std::ios::cur); // bits per sample
      const std::int64_t height = Number(file, 2);
      return SizeOf(Number(file, 2), height);
    }
    file.seekg(length - 2, std::ios::cur);
  }
  return std::nullopt;
}

}

Size ReadImageSize(const std::string& path)
{
  if (!IsFile(path))
  {
    return std::nullopt;
  }
  std::ifstream file(path, std::ios::binary);
  const std::int64_t signature = Number(file, 4);
  file.clear();
  Size size;
  if (signature == 0x89504e47)
  {
    size = SizeOfPng(file);
  }
  else if (signature >> 8 == 0xffd8ff)
  {
    size = SizeOfJpeg(file);
  }
  if (!size)
  {
    cv::Mat pixels;
    try
    {
      pixels = ReadImageFile(path, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
    }
    catch (const cv::Exception&)
    {
      pixels.release();
    }
    size = SizeOf(pixels.cols, pixels.rows);
  }
  return size;
}

}
