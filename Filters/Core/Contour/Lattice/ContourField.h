// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ContourField_h
#define freespace_ContourField_h

#include "Common/BoxContent.h"
#include "Common/Votes.h"

#include <Eigen/Geometry>

#include <vector>

namespace freespace
{

/// The origin of a part of the surface.
enum class SurfaceKind : unsigned char
{
  Feature = 0, ///< a triangle of a view's disparity map
  Wall = 1, ///< a silhouette wall: over the border of a view's map, through the camera's centre, or
            ///< a triangle that the view sees edge-on because it spans a jump in depth
  Hull = 2  ///< the convex hull of the features, or the bounds of the lattice
};

/// The label of a point of the surface.
struct SurfaceLabel
{
  int view = -1; ///< the view that carved it, below 8192; -1: none, it lies on the hull
  SurfaceKind kind = SurfaceKind::Hull;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< out of the matter; zero where not known
};

/// The parts of a field that are not decided in a box, so that nothing below the box asks the
/// others again. Only the field that wrote a scope can read it.
struct FieldScope
{
  std::vector<int> views;  ///< not of one opinion in all the box
  std::vector<int> planes; ///< of the hull, that the box is not wholly inside of
  VoteCount votes;         ///< of the views that are of one opinion in all the box
};

/// A solid as the contour sees it: each point is free or matter. Answers must be safe to ask from
/// several threads when IsThreadSafe.
class ContourField
{
public:
  virtual ~ContourField() = default;

  /// Whether the point is free, within a box whose scope Classify gave (or the root's).
  virtual bool IsFree(const Eigen::Vector3d& point, const FieldScope& scope) const = 0;

  /// The scope of all space.
  virtual FieldScope Root() const { return {}; }

  /// What a box inside the parent's box holds; for a mixed box, its scope. Conservative: Free and
  /// Matter are certain and agree with IsFree at every point of the box.
  virtual BoxContent Classify(
    const Eigen::AlignedBox3d& box, const FieldScope& parent, FieldScope& scope) const
  {
    scope = parent;
    return BoxContent::Mixed;
  }

  /// Where the surface crosses the segment from a matter to a free point, as a fraction of it, and
  /// what it is there: for fields that know better than by bisection. Where the segment crosses it
  /// more than once, the crossing nearest to the matter point. False: not known.
  virtual bool Crossing(const Eigen::Vector3d& matter, const Eigen::Vector3d& free,
    const FieldScope& scope, double& place, SurfaceLabel& label) const
  {
    return false;
  }

  /// What the surface between a free and a matter point close to it is, within a scope's box.
  virtual SurfaceLabel Label(
    const Eigen::Vector3d& free, const Eigen::Vector3d& matter, const FieldScope& scope) const
  {
    return {};
  }

  virtual bool IsThreadSafe() const { return false; }
};

}

#endif
