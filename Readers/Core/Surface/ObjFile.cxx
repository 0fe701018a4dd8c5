// SPDX-License-Identifier: BSD-3-Clause
#include "Surface/SurfaceFile.h"

#include "Common/Error.h"
#include "Surface/SurfaceWords.h"

#include <algorithm>

namespace freespace
{

namespace
{

// The point of a face's corner "7", "7/1", "7//3" or "7/1/3"; counted from 1, or from the end where it is
// negative; 0 is none.
std::int64_t PointOf(std::string_view corner, std::size_t points)
{
  const auto number = ParseNumber<std::int64_t>(corner.substr(0, corner.find('/')));
  if (!number || *number == 0)
  {
    return -1;
  }
  return *number > 0 ? *number - 1 : static_cast<std::int64_t>(points) + *number;
}

}

SurfaceFile ParseOBJ(const std::string& content, const std::string& file)
{
  SurfaceFile surface;
  surface.isDouble = true;
  std::size_t position = 0;
  std::size_t number = 0;
  while (position < content.size())
  {
    const std::size_t end = std::min(content.find('\n', position), content.size());
    const std::string_view line = std::string_view(content).substr(position, end - position);
    position = end + 1;
    ++number;
    SurfaceWords words(line, file);
    const std::string_view keyword = words.Next();
    if (keyword == "v")
    {
      std::array<double, 3> point;
      for (double& coordinate : point)
      {
        coordinate = words.Number<double>();
      }
      surface.points.push_back(point);
    }
    else if (keyword == "f")
    {
      for (std::string_view corner = words.Next(); !corner.empty(); corner = words.Next())
      {
        surface.corners.push_back(PointOf(corner, surface.points.size()));
      }
      surface.EndPolygon(file);
    }
    else if (keyword == "#")
    {
      surface.comments.emplace_back(
        line.substr(std::min<std::size_t>(line.find('#') + 2, line.size())));
    }
    else if (keyword.find('\0') != std::string_view::npos)
    {
      throw Error("Cannot read " + file + ": line " + std::to_string(number) +
        " is not text: it is no OBJ file.");
    }
  }
  return surface;
}

}
