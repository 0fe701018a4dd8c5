// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_MaskTriangles_h
#define freespace_MaskTriangles_h

#include "Disparity/OutlineTriangulation.h"

#include <opencv2/core.hpp>

namespace freespace
{

/// Triangles that fill the black parts of a mask (LoadMask), in pixel coordinates, without a margin of one pixel at
/// their boundary with other parts: the boundary of a mask is not more accurate than that. No edge at the boundary is
/// longer than 16 pixels, so that the triangles keep its shape when the lens's distortion is removed from their points.
PlanarTriangles MaskTriangles(const cv::Mat& mask);

}

#endif
