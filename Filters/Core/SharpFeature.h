// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SharpFeature_h
#define freespace_SharpFeature_h

#include <Eigen/Geometry>

#include <vector>

namespace freespace
{

/// The tangent plane of a surface at one of its points.
struct SurfacePlane
{
  Eigen::Vector3d point;
  Eigen::Vector3d normal; ///< unit length; zero where not known
};

/// Where planes that a surface has within a cell meet in a sharp edge or corner: the point that is
/// nearest to all of them in the sense of least squares. At an edge it is free along the edge: there
/// it comes as near to the middle of the points as it can within the box. An edge or corner that lies
/// outside, which is where the surface turns in a cell that no lattice edge tells of, is moved to the
/// nearest place in the box.
/// False when no two normals differ by the sharp angle or more, or when a normal is not known.
bool FindSharpFeature(const std::vector<SurfacePlane>& planes, double sharpCosine,
  const Eigen::AlignedBox3d& box, Eigen::Vector3d& position);

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
