// SPDX-License-Identifier: BSD-3-Clause
#include "Surface/SurfaceFile.h"

#include "Common/Error.h"
#include "Surface/SurfaceWords.h"

#include <algorithm>
#include <cstring>
#include <unordered_map>

namespace freespace
{

namespace
{

constexpr std::size_t headerSize = 84, triangleSize = 50;

struct PointHash
{
  std::size_t operator()(const std::array<double, 3>& point) const
  {
    std::size_t hash = 0;
    for (double coordinate : point)
    {
      hash = hash * 1000003u ^ std::hash<double>()(coordinate);
    }
    return hash;
  }
};

/// Collects triangles and merges equal corners.
class Corners
{
public:
  void Add(const std::array<double, 3>& point)
  {
    const auto next = static_cast<std::int64_t>(this->Surface.points.size());
    const auto [place, isNew] = this->Places.emplace(point, next);
    if (isNew)
    {
      this->Surface.points.push_back(point);
    }
    this->Surface.corners.push_back(place->second);
    if (this->Surface.corners.size() % 3 == 0)
    {
      this->Surface.ends.push_back(static_cast<std::int64_t>(this->Surface.corners.size()));
    }
  }

  SurfaceFile Surface;

private:
  std::unordered_map<std::array<double, 3>, std::int64_t, PointHash> Places;
};

SurfaceFile ParseBinary(const std::string& content, std::size_t triangles)
{
  Corners corners;
  for (std::size_t t = 0; t < triangles; ++t)
  {
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      float values[3]; // after the normal
      std::memcpy(
        values, content.data() + headerSize + triangleSize * t + 12 * (corner + 1), sizeof values);
      corners.Add({ values[0], values[1], values[2] });
    }
  }
  // Padded with zeros.
  corners.Surface.comments.emplace_back(
    content.substr(0, std::min(content.find('\0'), headerSize - 4)));
  return std::move(corners.Surface);
}

SurfaceFile ParseText(const std::string& content, const std::string& file)
{
  Corners corners;
  corners.Surface.isDouble = true;
  SurfaceWords words(content, file);
  bool isEnded = false;
  for (std::string_view word = words.Next(); !word.empty(); word = words.Next())
  {
    isEnded = isEnded || word == "endsolid";
    if (word == "vertex")
    {
      std::array<double, 3> point;
      for (double& coordinate : point)
      {
        coordinate = words.Number<double>();
      }
      corners.Add(point);
    }
  }
  if (!isEnded || corners.Surface.corners.size() % 3 != 0)
  {
    throw Error("Cannot read " + file + ": it is truncated or not an STL file.");
  }
  return std::move(corners.Surface);
}

}

SurfaceFile ParseSTL(const std::string& content, const std::string& file)
{
  std::uint32_t triangles = 0;
  if (content.size() >= headerSize)
  {
    // Little-endian, as all machines that VTK runs on today.
    std::memcpy(&triangles, content.data() + headerSize - 4, sizeof triangles);
    if (content.size() == headerSize + triangleSize * std::size_t(triangles))
    {
      return ParseBinary(content, triangles);
    }
  }
  if (content.compare(0, 5, "solid") != 0)
  {
    throw Error("Cannot read " + file + ": it is truncated or not an STL file.");
  }
  return ParseText(content, file);
}

}
