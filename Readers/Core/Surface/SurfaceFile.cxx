// SPDX-License-Identifier: BSD-3-Clause
#include "Surface/SurfaceFile.h"

#include "Common/Error.h"
#include "Text/TextSource.h"

namespace freespace
{

void SurfaceFile::EndPolygon(const std::string& file)
{
  const std::size_t begin = this->ends.empty() ? 0 : static_cast<std::size_t>(this->ends.back());
  const auto count = static_cast<std::int64_t>(this->points.size());
  if (this->corners.size() < begin + 3)
  {
    throw Error("Cannot read " + file + ": polygon " + std::to_string(this->ends.size() + 1) +
      " has fewer than three corners.");
  }
  for (std::size_t i = begin; i < this->corners.size(); ++i)
  {
    if (this->corners[i] < 0 || this->corners[i] >= count)
    {
      throw Error("Cannot read " + file + ": polygon " + std::to_string(this->ends.size() + 1) +
        " has a corner that is none of the " + std::to_string(count) + " points.");
    }
  }
  this->ends.push_back(static_cast<std::int64_t>(this->corners.size()));
}

SurfaceFile ReadPLY(const std::string& file)
{
  return ParsePLY(ReadWholeFile(file), file);
}

SurfaceFile ReadOBJ(const std::string& file)
{
  return ParseOBJ(ReadWholeFile(file), file);
}

SurfaceFile ReadSTL(const std::string& file)
{
  return ParseSTL(ReadWholeFile(file), file);
}

}
