// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SurfaceFile_h
#define freespace_SurfaceFile_h

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace freespace
{

/// The polygons of a surface as stored in a file.
struct SurfaceFile
{
  bool isDouble = false; ///< whether the file has more than single precision
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<std::uint8_t, 3>> colors; ///< of the points; may be empty
  std::vector<std::int64_t> corners;               ///< of all polygons, indices into the points
  std::vector<std::int64_t> ends;                  ///< of each polygon in `corners`
  std::vector<std::string> comments;               ///< an STL's header is one

  /// Ends a polygon whose corners were appended. Throws Error naming the file unless it has three
  /// corners or more and all of them are among the points.
  void EndPolygon(const std::string& file);
};

/// Each reads a file and throws Error naming it where it is missing, truncated or not of its format. A file
/// is not trusted: sizes are checked against its length and indices against the number of points, and the
/// memory is a small multiple of the file's length. Numbers do not depend on the
/// locale.
SurfaceFile ReadPLY(const std::string& file);
SurfaceFile ReadOBJ(const std::string& file);

/// Equal corners become one point.
SurfaceFile ReadSTL(const std::string& file);

/// The same from a file's content; the name is used in error messages.
SurfaceFile ParsePLY(const std::string& content, const std::string& file);
SurfaceFile ParseOBJ(const std::string& content, const std::string& file);
SurfaceFile ParseSTL(const std::string& content, const std::string& file);

}

#endif
