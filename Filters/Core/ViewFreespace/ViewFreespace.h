// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ViewFreespace_h
#define freespace_ViewFreespace_h

#include "Common/BoxContent.h"
#include "Common/CancellationFlag.h"
#include "Common/DisparityMap.h"
#include "ViewFreespace/DisparityRaster.h"
#include "ViewFreespace/FreeIntervals.h"

#include <Eigen/Geometry>

namespace freespace
{

/// The star-shaped free space of one view: the points in front of its triangulated disparity map.
///
/// Triangles with a point that is not finite or not in front of the camera, and triangles without
/// area in the image, are left out. Points that are behind the camera, or project outside of all
/// triangles, are not claimed by the view.
class ViewFreespace
{
public:
  /// Throws Aborted soon after the flag is set.
  explicit ViewFreespace(const DisparityMap& map, const CancellationFlag& stop = NeverCancelled);

  /// The classification of a point by the view.
  struct Sample
  {
    int triangle = -1;  ///< of the map, on the point's viewing ray; -1: not claimed
    double value = 0.0; ///< depth of the map less depth of the point; positive: free
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero(); ///< of the value
  };
  Sample At(const Eigen::Vector3d& point) const;

  /// The sign of At, faster: whether the point is in front of the map.
  bool IsFree(const Eigen::Vector3d& point) const;

  /// The normal of the silhouette wall between a claimed point and one close to it that is not
  /// claimed: the wall is the plane through the camera's centre and the border edge between their
  /// projections. Points to the claimed side.
  Eigen::Vector3d WallNormal(const Eigen::Vector3d& claimed, const Eigen::Vector3d& beyond) const;

  /// The parts of a segment that are in front of the map, see VisitFreeIntervals.
  using Intervals = freespace::Intervals;
  void FreeIntervals(
    const Eigen::Vector3d& first, const Eigen::Vector3d& last, Intervals& intervals) const;

  /// The same one by one, until the visitor returns false.
  using IntervalVisitor = freespace::IntervalVisitor;
  void VisitFreeIntervals(
    const Eigen::Vector3d& first, const Eigen::Vector3d& last, const IntervalVisitor& visit) const
  {
    freespace::VisitFreeIntervals(this->Raster, first, last, visit);
  }

  /// Whether the angle of incidence on a surface with this normal is above 85 degrees, so that it
  /// must be a depth jump: a triangle from an occluding edge to the background, which no view has
  /// observed.
  bool IsEdgeOn(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

  /// Free: all of the box is in front of the map; Matter: no point of it is. Conservative.
  BoxContent Classify(const Eigen::AlignedBox3d& box) const { return this->Raster.Classify(box); }

  /// The same for boxes that span no more than a few cells of the raster, from the triangles
  /// themselves: it tends to the exact answer as the box shrinks. Mixed for larger boxes.
  BoxContent ClassifyFinely(const Eigen::AlignedBox3d& box) const
  {
    return this->Raster.ClassifyFinely(box);
  }

  /// Whether the view may claim some point of the box, as free or as matter. Conservative.
  bool MayClaim(const Eigen::AlignedBox3d& box) const { return this->Raster.MayCover(box); }

  /// The camera's centre.
  const Eigen::Vector3d& Center() const { return this->Eye; }

  std::size_t NumberOfTriangles() const { return this->Raster.Mesh().Triangles().size(); }

private:
  DisparityRaster Raster;
  Eigen::Vector3d Eye; ///< the camera's centre
};

}

#endif
