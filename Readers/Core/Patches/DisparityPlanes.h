// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_DisparityPlanes_h
#define freespace_DisparityPlanes_h

#include "Common/View.h"
#include "Patches/PatchAligner.h"

#include <opencv2/core.hpp>

namespace freespace
{

/// The disparity between a view's features: linear over the triangles of their Delaunay triangulation in
/// the image. Triangles so steep that they are bridges have none.
class DisparityPlanes
{
public:
  /// Throws Error, naming the view, when it has fewer than three features or all are collinear.
  explicit DisparityPlanes(const View& view);

  /// The plane that fits the disparities of a window around a pixel best, and their standard deviation
  /// from it. False near the rim of the view's triangles, near a bridge and at a depth jump.
  bool Fit(const Eigen::Vector2d& pixel, PatchPlane& plane, double& roughness) const;

private:
  void Paint(const View& view, const std::array<int, 3>& corners);

  cv::Mat1f Disparity; // at the pixels' centres; 0: none
  double Steepest;     // slope of a disparity, as a fraction of it per pixel
};

}

#endif
