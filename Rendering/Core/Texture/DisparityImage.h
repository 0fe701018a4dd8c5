// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_DisparityImage_h
#define freespace_DisparityImage_h

#include "Common/Camera.h"
#include "Mesh/TriangleMesh.h"

#include <vector>

namespace freespace
{

/// The greatest disparity, 1 / depth, that a camera sees of a surface at each of its pixels'
/// centres: a depth buffer. It is affine over the image of a plane, so that linear interpolation
/// between pixels is exact there.
struct DisparityImage
{
  int width = 0;
  int height = 0;
  std::vector<float> values; ///< row by row, top first; 0 where there is no surface

  float At(int column, int row) const
  {
    return this->values[std::size_t(row) * this->width + column];
  }
};

/// Both sides of each triangle are seen. What reaches behind the camera is cut off; triangles
/// with a point that is not finite are left out.
DisparityImage RenderDisparity(const TriangleMesh& mesh, const Camera& camera);

}

#endif
