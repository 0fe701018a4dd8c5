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
/// it comes as near to the middle of the points as it can within the box.
/// False when no two normals differ by the sharp angle or more, when a normal is not known, or when
/// the edge or corner is not in the box.
bool FindSharpFeature(const std::vector<SurfacePlane>& planes, double sharpCosine,
  const Eigen::AlignedBox3d& box, Eigen::Vector3d& position);

}

#endif
