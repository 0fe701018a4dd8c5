// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_PieceStream_h
#define freespace_PieceStream_h

#include "Files/AtomicOutput.h"

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <vector>

class vtkPolyData;

namespace freespace
{

/// Writes a contour to a .ply piece by piece, so that only one piece is in memory: the file is, byte for
/// byte, the one that the writer makes of the whole surface. Only points that pieces share stay in memory. Until the
/// end the disk holds the surface about twice.
class PieceStream
{
public:
  /// Throws Error when the file's folder cannot be written.
  explicit PieceStream(const std::string& fileName);

  /// The next piece, in their order. Throws Error when the disk is full, or there are more points than a
  /// .ply can count.
  void Add(vtkPolyData* piece);

  /// Assembles the file, with a comment unless that is empty; the global shift is subtracted from all points. Throws
  /// Error when the disk is full.
  void Finish(
    const std::string& comment = "", const Eigen::Vector3d& globalShift = Eigen::Vector3d::Zero());

  /// Of the points so far.
  const Eigen::AlignedBox3d& Bounds() const { return this->Box; }

  std::int64_t NumberOfPoints() const { return this->Points; }
  std::int64_t NumberOfTriangles() const { return this->Triangles; }

private:
  using Position = std::array<double, 3>;

  void FindShared();
  bool AreSingle(const Eigen::Vector3d& globalShift);
  void WriteWhole(
    const std::string& fileName, const std::string& comment, const Eigen::Vector3d& globalShift);
  void Check(bool isGood) const;

  std::string Name;
  AtomicOutput Target;
  std::fstream PointFile;    ///< three doubles each
  std::fstream TriangleFile; ///< three 32-bit integers each, -1 - n for shared point n
  std::map<Position, std::int32_t> Shared;
  std::vector<std::int32_t> SharedPlace;
  std::int64_t Points = 0, Triangles = 0;
  Eigen::AlignedBox3d Box;
};

}

#endif
