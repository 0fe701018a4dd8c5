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

  /// A direction from the position that is above all planes by as much, unit length; zero where there is
  /// none.
  Eigen::Vector3d Up() const;

  /// Moves the position along the edge to the nearest place in a box. False: there is none, and the
  /// position is as it was.
  bool SlideInto(const Eigen::AlignedBox3d& box);

  /// Whether the surface has the feature within a reach of the position: of the four (eight at a
  /// corner) places that the planes part there, the one above all of them is free, the one below
  /// all is matter, and each plane makes a difference somewhere.
  bool IsConfirmed(
    double reach, const std::function<bool(const Eigen::Vector3d& point)>& isFree) const;
};

/// The point that is nearest to all planes in the sense of least squares; at an edge the one of these
/// that is nearest to the middle of the planes' points.
/// False when no two normals differ by the sharp angle or more, or when a normal is not known.
bool FindSharpFeature(
  const std::vector<SurfacePlane>& planes, double sharpCosine, SharpFeature& feature);

/// The same as a place in a box: an edge or corner that lies outside, which is where the surface turns
/// in a cell that no lattice edge tells of, is moved to the nearest place in the box.
bool FindSharpFeature(const std::vector<SurfacePlane>& planes, double sharpCosine,
  const Eigen::AlignedBox3d& box, Eigen::Vector3d& position);

/// The corner where a plane cuts an edge. False when it is not far enough from parallel to it.
bool FindCornerOnEdge(
  const SharpFeature& edge, const SurfacePlane& plane, double sharpCosine, SharpFeature& corner);

/// Moves a point along a direction out of the matter to the surface: up when it is in matter, otherwise
/// down. Looks in steps of a sixteenth of the box. False: the surface is not met within the box, and the
/// point is where it was.
bool MoveToBoundary(Eigen::Vector3d& point, const Eigen::Vector3d& up,
  const Eigen::AlignedBox3d& box, const std::function<bool(const Eigen::Vector3d& point)>& isFree);

/// Whether some two normals differ by more than the angle.
bool NormalsDiffer(const std::vector<SurfacePlane>& planes, double cosine);

/// Makes normals agree with those around, the planes' own among them, that differ little: a surface
/// that is rough at a scale below the cells', as that of many noisy views is, has no edges there.
/// Normals on the two sides of a sharp edge do not mix. Weights fall as a Gaussian whose sigma is the
/// radius; normals that are not known stay so.
void SmoothNormals(
  std::vector<SurfacePlane>& planes, const std::vector<SurfacePlane>& around, double radius);

}

#endif
