// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_PlyWriter_h
#define freespace_PlyWriter_h

#include "vtkFreespaceWritersModule.h" // for the export macro

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

class vtkPolyData;

namespace freespace
{

/// What the header of a binary PLY says.
struct PlyHeader
{
  std::vector<std::string> comments; ///< one line each; empty ones are left out
  bool isDouble = false;
  bool hasNormals = false; ///< single precision
  bool isColored = false;
  std::int64_t vertices = 0, faces = 0;

  VTKFREESPACEWRITERS_EXPORT std::string Text() const;
};

/// Whether single precision keeps a coordinate as it is.
inline bool IsSingle(double coordinate)
{
  return static_cast<double>(static_cast<float>(coordinate)) == coordinate;
}

/// Writes the points and polygons of a surface as a binary PLY, in double precision where single precision
/// does not keep every coordinate, with the colours of the points that `colors`
/// names, and the normals of the array Normals, where they are. The global shift is subtracted from the points and
/// is a comment, after the given one. False where the disk fails. Throws Error where there are more points than a PLY
/// can count.
bool WritePLY(vtkPolyData* surface, const std::string& colors, const std::string& comment,
  const Eigen::Vector3d& globalShift, const std::string& fileName);

}

#endif
