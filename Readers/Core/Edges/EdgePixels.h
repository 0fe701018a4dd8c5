// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_EdgePixels_h
#define freespace_EdgePixels_h

#include "Edges/LargeVector.h"

#include <vector>

namespace cv
{
class Mat;
}

namespace freespace
{

/// A pixel on an edge, with sub-pixel position.
struct EdgePoint
{
  float x, y;     ///< pixels, the centre of the first one at (0, 0)
  float gx, gy;   ///< gradient, grey levels per pixel
  float contrast; ///< its length, in the noise of middle grey
};

/// Points and their links. Who goes along an edge finds the numbers close together.
struct LinkedPoints
{
  LargeVector<EdgePoint> points;
  std::vector<int> next;     ///< of each point the one that goes on with the edge, the gradient
                             ///< pointing to the right; -1 for none
  std::vector<int> previous; ///< the point whose next one is this; -1 for none
};

/// The points of an image where the slope is greatest across the edge (Canny), by Devernay's
/// sub-pixel correction, row by row, linked to the nearest that goes on. The image has 8 bits, one or
/// three channels; see EdgeTokenOptions for smoothing and contrast. (OpenCV's EdgeDrawing takes twice
/// as long for whole pixels, and chains refined from it lead to fewer matches of the same precision.)
LinkedPoints FindEdgePixels(const cv::Mat& image, double smoothing, double lowContrast);

}

#endif
