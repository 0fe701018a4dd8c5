// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_VisiblePoints_h
#define freespace_VisiblePoints_h

#include "Common/Camera.h"
#include "Mesh/TriangleMesh.h"

#include <vector>

namespace freespace
{

/// The points of a surface that a camera sees, approximately: by a depth buffer coarser than its image.
std::vector<Eigen::Vector3d> VisiblePoints(const TriangleMesh& mesh, const Camera& camera);

}

#endif
