// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ViewFreespace_h
#define freespace_ViewFreespace_h

#include "Common/BoxContent.h"
#include "Common/CancellationFlag.h"
#include "Common/DisparityMap.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <functional>

namespace freespace
{

/// The star-shaped free space of one view: the points in front of its triangulated disparity map.
///
/// A point is found in the map in constant time: a raster over the image keeps for each cell one
/// triangle that touches it, from which a short bounded walk leads to the point's triangle. Every
/// edge is judged from its same end by both of its triangles, so that a point on a shared edge is
/// never lost between them. The raster also keeps bounds of the disparity in each cell, which
/// decide most points before any triangle is looked at, and a pyramid of them answers for whole
/// boxes.
///
/// Triangles that touch a point which is not finite or not in front of the camera, and triangles
/// without area in the image, are left out. Points that are behind the camera, or outside of all
/// triangles in the image, are not claimed by the view.
class ViewFreespace
{
public:
  /// Throws Aborted soon after the flag is set.
  explicit ViewFreespace(const DisparityMap& map, const CancellationFlag& stop = NeverCancelled);

  /// What the view knows of a point.
  struct Sample
  {
    int triangle = -1;  ///< of the map, below the point; -1: the view claims nothing
    double value = 0.0; ///< depth of the map less depth of the point; positive: free
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero(); ///< of the value
  };
  Sample At(const Eigen::Vector3d& point) const;

  /// The sign of At alone: whether the view says that the point is free.
  bool IsFree(const Eigen::Vector3d& point) const;

  /// The normal of the silhouette wall between a claimed point and one close to it that is not: of
  /// the plane through the camera's centre and the border edge between them in the image. Points to
  /// the claimed side.
  Eigen::Vector3d WallNormal(const Eigen::Vector3d& claimed, const Eigen::Vector3d& beyond) const;

  /// The parts of a segment that the view says are free, as ranges of [0, 1] from its first point to
  /// its last, in ascending order and apart. Exact: along a segment all is linear within a triangle,
  /// and neighbouring triangles hand over at exactly the same place. Time in proportion to the
  /// segment's length in the image.
  using Intervals = std::vector<std::pair<double, double>>;
  void FreeIntervals(
    const Eigen::Vector3d& first, const Eigen::Vector3d& last, Intervals& intervals) const;

  /// The same one by one, until the visitor returns false: it has seen enough.
  using IntervalVisitor = std::function<bool(double begin, double end)>;
  void VisitFreeIntervals(
    const Eigen::Vector3d& first, const Eigen::Vector3d& last, const IntervalVisitor& visit) const;

  /// Whether the view sees a surface of this normal so nearly edge-on (above 85 degrees) that it must
  /// be a jump in depth: a triangle from an occluding edge to what lies behind it, which nobody saw.
  bool IsEdgeOn(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

  /// Free: the view says so for all the box; Matter: for no point of it. Conservative.
  BoxContent Classify(const Eigen::AlignedBox3d& box) const;

  /// The same for boxes that span no more than a few cells of the raster, from the triangles
  /// themselves: it tends to the exact answer as the box shrinks. Mixed for larger boxes.
  BoxContent ClassifyFinely(const Eigen::AlignedBox3d& box) const;

  /// Whether the view may claim some point of the box, as free or as matter. Conservative.
  bool MayClaim(const Eigen::AlignedBox3d& box) const
  {
    return !this->Triangles.empty() && !this->FootprintOf(box).isBehind;
  }

  std::size_t NumberOfTriangles() const { return this->Triangles.size(); }

private:
  /// In raster coordinates (a cell is 1 wide, the raster begins at 0).
  struct Triangle
  {
    std::array<int, 3> corner;   ///< positively turned
    std::array<int, 3> neighbor; ///< beyond the edge from corner i to corner i + 1; -1: the border
    double slopeX, slopeY;       ///< of the disparity
    int id;                      ///< in the map
  };
  struct Corner
  {
    Eigen::Vector2d position;
    double disparity;
  };
  struct Cell
  {
    float low;    ///< a bound below all disparities in the cell; infinite where no triangle is
    float high;   ///< a bound above; infinite where not all of the cell is covered
    int triangle; ///< one that touches the cell, or -1
  };
  struct Level
  {
    int width, height;
    std::vector<std::pair<float, float>> bounds;
  };
  /// The cells that a box's image touches.
  struct Footprint
  {
    bool isBehind;            ///< the box is behind the camera, or beside the raster
    bool isAround;            ///< the box is too close to the camera to tell
    bool isWithin;            ///< no part of the image is beside the raster
    double nearest, furthest; ///< depths
    int low[2], high[2];
  };
  Footprint FootprintOf(const Eigen::AlignedBox3d& box) const;

  struct Pixel
  {
    double x, y, depth;
  };

  Eigen::Vector3d Raster(const Eigen::Vector3d& point) const
  {
    return this->RasterFromWorld.leftCols<3>() * point + this->RasterFromWorld.col(3);
  }
  bool Project(const Eigen::Vector3d& point, Pixel& pixel) const;
  Eigen::Vector3d LineThrough(int a, int b) const;
  Eigen::Vector3d PlaneOf(const Triangle& triangle) const;
  void ClipToTriangle(const Triangle& triangle, const Eigen::Vector3d& first,
    const Eigen::Vector3d& last, double& begin, double& end) const;
  struct Walk
  {
    bool ended;   ///< false: it grew too long
    int triangle; ///< where it ended
    int border;   ///< the edge of the triangle that it would have left the map by, or -1
  };
  Walk WalkTo(double x, double y, int start) const;
  std::size_t CellAt(double x, double y) const
  {
    return static_cast<std::size_t>(static_cast<int>(y)) * this->Width + static_cast<int>(x);
  }
  int LocateInCell(double x, double y) const;
  class SegmentWalk;
  void AddFreeInCell(std::size_t cell, const Eigen::Vector3d& first, const Eigen::Vector3d& last,
    double begin, double end, Intervals& intervals) const;
  int Find(const Pixel& pixel) const;
  double Disparity(const Triangle& triangle, double x, double y) const;
  double Turn(int a, int b, double x, double y) const;

  void AddTriangles(const DisparityMap& map);
  void SortByPlace();
  void LinkNeighbors(const CancellationFlag& stop);
  void MakeRaster(const CancellationFlag& stop);
  template <typename Visit>
  void VisitRows(const Eigen::Vector2d* polygon, int corners, Visit&& visit) const;
  void MakePyramid();

  Eigen::Matrix<double, 3, 4> RasterFromWorld; ///< homogeneous; its last row is the depth
  Eigen::Vector3d Eye;
  std::vector<Corner> Corners;
  std::vector<Triangle> Triangles;
  int Width = 0, Height = 0; ///< of the raster
  std::vector<Cell> Cells;
  std::vector<int> ListBegin, List; ///< all triangles that touch each cell
  std::vector<Level> Pyramid;       ///< from the raster up
};

}

#endif
