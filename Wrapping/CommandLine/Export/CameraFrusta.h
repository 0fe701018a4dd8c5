// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_CameraFrusta_h
#define freespace_CameraFrusta_h

#include "Common/Camera.h"
#include "Mesh/TriangleMesh.h"

#include <vector>

namespace freespace
{

/// Cameras as pyramids: from the centre to the corners of the image at a depth, and a triangle above the upper edge.
/// Of each camera 6 points (centre; upper left, upper right, lower right, lower left; above) and 5 triangles.
TriangleMesh CameraFrusta(const std::vector<Camera>& cameras, double depth);

/// A depth at which frusta are seen well but hardly meet: a third of the median distance of each camera to the nearest
/// other one. 1 for a single camera.
double FrustumDepth(const std::vector<Camera>& cameras);

}

#endif
