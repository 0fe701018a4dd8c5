// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_DisparityRange_h
#define freespace_DisparityRange_h

#include "Common/Camera.h"

namespace freespace
{

/// A range of disparities (1 / depth in the reference camera); empty when maximum < minimum.
struct DisparityRange
{
  double minimum = 0;
  double maximum = 0;

  bool Empty() const { return !(this->minimum < this->maximum); }
};

/// The part of `within` for which a point on the ray through the reference's pixel is seen in the
/// other image.
DisparityRange VisibleRange(const Camera& reference, const Eigen::Vector2d& pixel,
  const Camera& other, const DisparityRange& within);

/// Smallest range that holds the disparities of all points which all three images see, on a grid of
/// the reference's rays. Empty when the images have no overlap.
DisparityRange CommonRange(
  const Camera& reference, const Camera& first, const Camera& second, const DisparityRange& within);

}

#endif
