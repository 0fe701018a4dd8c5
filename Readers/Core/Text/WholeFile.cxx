// SPDX-License-Identifier: BSD-3-Clause
#include "Text/WholeFile.h"

#include "Common/Error.h"
#include "Common/ParseNumber.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

namespace freespace
{

namespace
{

std::ifstream Open(const std::string& fileName)
{
  std::ifstream file;
  if (std::filesystem::is_regular_file(fileName))
  {
    file.open(fileName, std::ios::binary);
  }
  if (!file.is_open())
  {
    throw Error("Cannot read " + fileName + ": there is no such file.");
  }
  return file;
}

[[noreturn]] void ThrowCutOff(const std::string& fileName, const std::string& format)
{
  throw Error("Cannot read " + fileName + ": it is truncated or not " + format + ".");
}

std::string Tail(std::ifstream& file, std::streamoff length)
{
  file.seekg(0, std::ios::end);
  const std::streamoff size = file.tellg();
  std::string tail(static_cast<std::size_t>(std::min(size, length)), '\0');
  file.seekg(size - static_cast<std::streamoff>(tail.size()));
  file.read(tail.data(), static_cast<std::streamsize>(tail.size()));
  return tail;
}

// The content of a PLY header.
struct PLYHeader
{
  bool whole = false;
  bool text = false;
  double elements = 0;   // all counts together
  double leastBytes = 0; // size of the elements in a binary file if lists are triangles
};

double ScalarSize(const std::string& type)
{
  static const std::map<std::string, double> sizes = { { "char", 1 }, { "uchar", 1 }, { "int8", 1 },
    { "uint8", 1 }, { "short", 2 }, { "ushort", 2 }, { "int16", 2 }, { "uint16", 2 }, { "int", 4 },
    { "uint", 4 }, { "int32", 4 }, { "uint32", 4 }, { "float", 4 }, { "float32", 4 },
    { "double", 8 }, { "float64", 8 } };
  const auto size = sizes.find(type);
  return size == sizes.end() ? 1 : size->second;
}

PLYHeader ReadPLYHeader(std::ifstream& file)
{
  PLYHeader header;
  std::string line;
  double count = 0;
  if (!std::getline(file, line) || line.rfind("ply", 0) != 0)
  {
    return header;
  }
  while (std::getline(file, line))
  {
    std::istringstream words(line);
    std::string keyword, first, second, third;
    words >> keyword >> first >> second >> third;
    if (keyword == "end_header")
    {
      header.whole = true;
      break;
    }
    if (keyword == "format")
    {
      header.text = first == "ascii";
    }
    else if (keyword == "element")
    {
      count = ParseNumber<double>(second).value_or(0);
      header.elements += count;
    }
    else if (keyword == "property")
    {
      const bool list = first == "list";
      header.leastBytes +=
        count * (list ? ScalarSize(second) + 3 * ScalarSize(third) : ScalarSize(first));
    }
  }
  return header;
}

// The position of the first marker after the coded data at `at`, in which stuffed bytes are no markers.
std::size_t NextMarker(const std::string& bytes, std::size_t at)
{
  const auto isData = [](unsigned char code)
  { return code == 0 || (code >= 0xD0 && code <= 0xD7); };
  while (at + 1 < bytes.size() && (bytes[at] != '\xFF' || isData(bytes[at + 1])))
  {
    ++at;
  }
  return at;
}

// Walks over the segments of a JPEG, whose lengths have two bytes, to the end marker.
bool HasEndOfJPEG(const std::string& bytes)
{
  constexpr unsigned char endOfImage = 0xD9, startOfScan = 0xDA, fill = 0xFF;
  std::size_t at = 2;
  while (at + 3 < bytes.size() && bytes[at] == '\xFF')
  {
    const unsigned char code = bytes[at + 1];
    if (code == endOfImage)
    {
      return true;
    }
    if (code == fill)
    {
      ++at;
      continue;
    }
    at += 2 + 256 * static_cast<unsigned char>(bytes[at + 2]) +
      static_cast<unsigned char>(bytes[at + 3]);
    at = code == startOfScan ? NextMarker(bytes, at) : at;
  }
  return at + 1 < bytes.size() && bytes[at] == '\xFF' &&
    static_cast<unsigned char>(bytes[at + 1]) == endOfImage;
}

}

void CheckWholeVTKFile(const std::string& fileName)
{
  std::ifstream file = Open(fileName);
  if (Tail(file, 32).find("</VTKFile>") == std::string::npos)
  {
    ThrowCutOff(fileName, "a file of VTK");
  }
}

void CheckWholePLY(const std::string& fileName)
{
  std::ifstream file = Open(fileName);
  const PLYHeader header = ReadPLYHeader(file);
  bool whole = header.whole;
  if (whole && header.text)
  {
    double lines = 0;
    for (std::string line; lines < header.elements && std::getline(file, line);)
    {
      lines += line.find_first_not_of(" \t\r") != std::string::npos;
    }
    whole = lines >= header.elements;
  }
  else if (whole)
  {
    const std::streamoff body = file.tellg();
    file.seekg(0, std::ios::end);
    whole = static_cast<double>(file.tellg() - body) >= header.leastBytes;
  }
  if (!whole)
  {
    ThrowCutOff(fileName, "a PLY file");
  }
}

void CheckWholeSTL(const std::string& fileName)
{
  constexpr std::uintmax_t headerSize = 84, triangleSize = 50;
  std::ifstream file = Open(fileName);
  char header[headerSize] = {};
  file.read(header, headerSize);
  const bool hasHeader = file.gcount() == static_cast<std::streamsize>(headerSize);
  std::uint32_t triangles = 0;
  std::memcpy(&triangles, header + 80, 4); // little-endian, as all machines that VTK runs on today
  const bool binary = hasHeader &&
    std::filesystem::file_size(fileName) == headerSize + triangleSize * std::uintmax_t(triangles);
  file.clear();
  const bool text =
    std::strncmp(header, "solid", 5) == 0 && Tail(file, 512).find("endsolid") != std::string::npos;
  if (!binary && !text)
  {
    ThrowCutOff(fileName, "an STL file");
  }
}

void CheckWholeJPEG(const std::string& fileName)
{
  std::ifstream file = Open(fileName);
  std::string bytes(3, '\0');
  file.read(bytes.data(), 3);
  if (!file || bytes != "\xFF\xD8\xFF")
  {
    return;
  }
  std::ostringstream rest;
  rest << file.rdbuf();
  bytes += rest.str();
  if (!HasEndOfJPEG(bytes))
  {
    throw Error("Cannot read the image " + fileName + ": it is damaged or truncated.");
  }
}

}
