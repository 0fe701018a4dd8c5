// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_FeatureHull_h
#define freespace_FeatureHull_h

#include "Common/BoxContent.h"
#include "Common/CancellationFlag.h"

#include <Eigen/Geometry>

#include <mutex>
#include <vector>

namespace freespace
{

/// The convex hull of all features with a margin: outside it everything is free
/// (section 2.2: "the reconstructed surface should not extend beyond the convex hull").
///
/// It is kept as the intersection of half-spaces n.x <= h: the planes of the hull's facets, each
/// moved out by the margin, and the supporting planes in 26 directions of a cube (faces, edges,
/// corners), likewise moved, which cut off the long spikes that the facets alone would leave at
/// sharp edges. So hulls without volume (coplanar, collinear or single points) are bounded and,
/// with a margin, thick.
class FeatureHull
{
public:
  /// Points that are not finite are left out. Without any point everything is outside.
  /// The margin is in the points' unit. Throws Aborted soon after the flag is set.
  FeatureHull(const std::vector<Eigen::Vector3d>& points, double margin,
    const CancellationFlag& stop = NeverCancelled);

  /// Those of the points, all finite, that can be corners of their hull, and perhaps some more: a
  /// fraction of the many that lie well inside.
  static std::vector<Eigen::Vector3d> OuterPoints(
    const std::vector<Eigen::Vector3d>& points, const CancellationFlag& stop = NeverCancelled);

  bool IsEmpty() const { return this->Normals.cols() == 0; }

  /// Bounding box of the hull with its margin; empty without points.
  const Eigen::AlignedBox3d& Bounds() const { return this->Box; }

  int NumberOfPlanes() const { return static_cast<int>(this->Normals.cols()); }
  Eigen::Vector3d Normal(int plane) const { return this->Normals.col(plane); }

  /// Signed distance to a plane, positive outside.
  double Distance(int plane, const Eigen::Vector3d& point) const
  {
    return this->Normals.col(plane).dot(point) - this->Offsets[plane];
  }

  /// The plane that the point is furthest out of. Its distance is, inside, the exact distance to
  /// the hull (negative) and, outside, no more than the true one. -1 without points.
  /// Inside the bounds it looks only at the few planes that can be the nearest in a part of them.
  int NearestPlane(const Eigen::Vector3d& point) const;

  /// The same by looking at every plane.
  int NearestOfAll(const Eigen::Vector3d& point) const;

  /// What a box holds, given the planes that are still open; `open` gets those left.
  BoxContent Classify(
    const Eigen::AlignedBox3d& box, const std::vector<int>& parent, std::vector<int>& open) const;

private:
  /// A box of an octree over the bounds: eight children from First on, or the planes that can be the
  /// nearest in it.
  struct Node
  {
    int first = -1;
    std::vector<int> planes;
  };

  void Split(int node, const Eigen::AlignedBox3d& box, int depth) const;
  std::vector<int> Nearest(const Eigen::AlignedBox3d& box, const std::vector<int>& planes) const;

  Eigen::Matrix3Xd Normals; ///< unit length
  Eigen::VectorXd Offsets;
  Eigen::AlignedBox3d Box;
  mutable std::once_flag IsSplit; ///< the octree is made when it is first needed
  mutable std::vector<Node> Nodes;
};

}

#endif
