// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_EdgePoints_h
#define freespace_EdgePoints_h

#include <vector>

namespace cv
{
class Mat;
}

namespace freespace
{

/// A pixel on an edge, whose place is known to a fraction of a pixel.
struct EdgePoint
{
  float x, y;        ///< pixels, the centre of the first one at (0, 0)
  float gx, gy;      ///< gradient, grey levels per pixel
  float contrast;    ///< its length, in the noise of middle grey
  int next = -1;     ///< point that goes on with the edge, the gradient pointing to the right
  int previous = -1; ///< point whose next one is this
};

/// The points of an image where the slope is greatest across the edge (Canny), by Devernay's
/// sub-pixel correction, row by row, linked to the nearest that goes on. The image has 8 bits, one or
/// three channels; see EdgeTokenOptions for smoothing and contrast.
std::vector<EdgePoint> FindEdgePoints(const cv::Mat& image, double smoothing, double lowContrast);

}

#endif
