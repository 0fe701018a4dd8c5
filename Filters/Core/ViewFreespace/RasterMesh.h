// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_RasterMesh_h
#define freespace_RasterMesh_h

#include "Common/CancellationFlag.h"
#include "Common/DisparityMap.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <vector>

namespace freespace
{

/// The triangles of a disparity map in the coordinates of a raster over the image: a cell is 1 wide
/// and the raster begins at 0. The raster has a few square cells per triangle.
///
/// All triangles have the same orientation and are linked to their neighbours. Those with a point
/// that is not finite or not in front of the camera, and those without area in the image, are left
/// out.
class RasterMesh
{
public:
  struct Triangle
  {
    std::array<int, 3> corner;   ///< counter-clockwise
    std::array<int, 3> neighbor; ///< across the edge from corner i to corner i + 1; -1: the border
    double slopeX, slopeY;       ///< gradient of the disparity
    int id;                      ///< in the map
  };
  struct Corner
  {
    Eigen::Vector2d position;
    double disparity;
  };
  struct Pixel
  {
    double x, y, depth;
  };

  /// Throws Aborted soon after the flag is set.
  RasterMesh(const DisparityMap& map, const CancellationFlag& stop);

  const std::vector<Triangle>& Triangles() const { return this->AllTriangles; }
  const std::vector<Corner>& Corners() const { return this->AllCorners; }

  /// Of the raster; 0 without triangles.
  int Width() const { return this->Columns; }
  int Height() const { return this->Rows; }

  /// Homogeneous raster coordinates from world coordinates; the last row gives the depth.
  const Eigen::Matrix<double, 3, 4>& RasterFromWorld() const { return this->FromWorld; }

  Eigen::Vector3d Raster(const Eigen::Vector3d& point) const
  {
    return this->FromWorld.leftCols<3>() * point + this->FromWorld.col(3);
  }

  /// False where the point is behind the camera or beside the raster.
  bool Project(const Eigen::Vector3d& point, Pixel& pixel) const
  {
    const Eigen::Vector3d q = this->Raster(point);
    pixel = { q.x() / q.z(), q.y() / q.z(), q.z() };
    return q.z() > 0 && pixel.x >= 0 && pixel.y >= 0 && pixel.x < this->Columns &&
      pixel.y < this->Rows;
  }

  /// Twice the signed area of the triangle from an edge to a point. It is always computed from the
  /// edge's smaller corner, so that the two triangles of an edge get exactly opposite values.
  double Turn(int a, int b, double x, double y) const
  {
    const bool reversed = a > b;
    const Eigen::Vector2d& p = this->AllCorners[reversed ? b : a].position;
    const Eigen::Vector2d& q = this->AllCorners[reversed ? a : b].position;
    const double turn = (q.x() - p.x()) * (y - p.y()) - (q.y() - p.y()) * (x - p.x());
    return reversed ? -turn : turn;
  }

  /// The line through two corners as a homogeneous 3-vector, always from the smaller corner, see
  /// Turn.
  Eigen::Vector3d LineThrough(int a, int b) const
  {
    const Eigen::Vector2d& p = this->AllCorners[std::min(a, b)].position;
    const Eigen::Vector2d& q = this->AllCorners[std::max(a, b)].position;
    const Eigen::Vector3d line(p.y() - q.y(), q.x() - p.x(), p.x() * q.y() - q.x() * p.y());
    return a < b ? line : Eigen::Vector3d(-line);
  }

  /// The disparity of a triangle as a linear form on homogeneous raster coordinates: a point is in
  /// front of the triangle where the form is less than 1.
  Eigen::Vector3d PlaneOf(const Triangle& triangle) const
  {
    const Corner& corner = this->AllCorners[triangle.corner[0]];
    return Eigen::Vector3d(triangle.slopeX, triangle.slopeY,
      corner.disparity - triangle.slopeX * corner.position.x() -
        triangle.slopeY * corner.position.y());
  }

  /// The disparity of a triangle at a pixel, within the range of its corners.
  double Disparity(const Triangle& triangle, double x, double y) const;

  /// A walk from triangle to triangle.
  struct Walk
  {
    bool ended;   ///< false: it grew too long
    int triangle; ///< where it ended
    int border;   ///< the edge of the triangle where it would have left the map, or -1
  };

  /// Walks across the edges that separate the current triangle from the pixel, to the triangle that
  /// contains the pixel or to the border.
  Walk WalkTo(double x, double y, int start) const;

private:
  void AddTriangles(const DisparityMap& map);
  void ScaleToRaster();
  void DropFlatTriangles();
  void SortByTile();
  void LinkNeighbors(const CancellationFlag& stop);

  Eigen::Matrix<double, 3, 4> FromWorld;
  std::vector<Corner> AllCorners;
  std::vector<Triangle> AllTriangles;
  int Columns = 0, Rows = 0;
};

}

#endif
