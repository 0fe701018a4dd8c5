// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SharpFeature_h
#define freespace_SharpFeature_h

#include <Eigen/Geometry>

#include <functional>
#include <vector>

namespace freespace
{

/// The tangent plane of a surface at one of its points.
struct SurfacePlane
{
  Eigen::Vector3d point;
  Eigen::Vector3d normal; ///< unit length; zero where not known
};

/// A sharp edge or corner: where planes that a surface has near each other meet.
struct SharpFeature
{
  Eigen::Vector3d position;
  Eigen::Vector3d direction;            ///< along an edge, unit length; zero at a corner
  std::vector<Eigen::Vector3d> normals; ///< two planes at an edge, three at a corner
  bool isBorrowed = false;              ///< one of the planes is from elsewhere

  bool IsCorner() const { return this->normals.size() == 3; }

  /// The direction from the position that is at the same distance above all planes, unit length; zero if
  /// there is none.
  Eigen::Vector3d Up() const;

  /// Moves the position along the edge to the nearest position in a box. False if there is none; the
  /// position is then unchanged.
  bool SlideInto(const Eigen::AlignedBox3d& box);

  /// Whether the surface has the feature within a reach of the position: of the four (eight at a
  /// corner) sectors between the planes, the one above all of them is free, the one below all is matter,
  /// and each plane separates free space from matter somewhere.
  bool IsConfirmed(
    double reach, const std::function<bool(const Eigen::Vector3d& point)>& isFree) const;
};

/// The point that is nearest to all planes in the sense of least squares; at an edge the one of these
/// that is nearest to the middle of the planes' points.
/// False when no two normals differ by the sharp angle or more, or when a normal is not known.
bool FindSharpFeature(
  const std::vector<SurfacePlane>& planes, double sharpCosine, SharpFeature& feature);

/// The same within a box: an edge or corner that lies outside, because the surface turns in a cell
/// without a crossing there, is moved to the nearest position in the box.
bool FindSharpFeature(const std::vector<SurfacePlane>& planes, double sharpCosine,
  const Eigen::AlignedBox3d& box, Eigen::Vector3d& position);

/// The corner where a plane cuts an edge. False when it is not far enough from parallel to it.
bool FindCornerOnEdge(
  const SharpFeature& edge, const SurfacePlane& plane, double sharpCosine, SharpFeature& corner);

/// Moves a point along a direction out of the matter to the surface: up when it is in matter, otherwise
/// down. Searches in steps of a sixteenth of the box. False if the surface is not in the box; the point
/// is then unchanged.
bool MoveToBoundary(Eigen::Vector3d& point, const Eigen::Vector3d& up,
  const Eigen::AlignedBox3d& box, const std::function<bool(const Eigen::Vector3d& point)>& isFree);

/// Whether some two normals differ by more than the angle.
bool NormalsDiffer(const std::vector<SurfacePlane>& planes, double cosine);

/// Smooths normals over their neighbours with similar normals: a surface with roughness finer than the
/// cells, such as that of many noisy views, has no sharp edges there.
/// Normals on the two sides of a sharp edge do not mix. Weights fall as a Gaussian whose sigma is the
/// radius; unknown normals stay unknown.
void SmoothNormals(
  std::vector<SurfacePlane>& planes, const std::vector<SurfacePlane>& around, double radius);

}

#endif
