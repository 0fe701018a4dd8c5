// SPDX-License-Identifier: BSD-3-Clause
#include "Epipolar/DisparityRange.h"

#include <algorithm>
#include <limits>

namespace freespace
{

DisparityRange VisibleRange(const Camera& reference, const Eigen::Vector2d& pixel,
  const Camera& other, const DisparityRange& within)
{
  // The image of the ray's point is start + disparity * step, homogeneous: every border of the
  // image is a linear inequality in the disparity.
  const Eigen::Vector3d start = other.K * other.R * reference.Ray(pixel);
  const Eigen::Vector3d step = other.K * other.FromWorld(reference.Center());
  Eigen::Matrix<double, 5, 3> borders;
  borders << 1, 0, 0, -1, 0, other.width, 0, 1, 0, 0, -1, other.height, 0, 0, 1;
  const Eigen::Matrix<double, 5, 1> constant = borders * start, slope = borders * step;
  DisparityRange range = within;
  for (int i = 0; i < 5; ++i)
  {
    if (slope[i] > 0)
    {
      range.minimum = std::max(range.minimum, -constant[i] / slope[i]);
    }
    else if (slope[i] < 0)
    {
      range.maximum = std::min(range.maximum, -constant[i] / slope[i]);
    }
    else if (constant[i] < 0)
    {
      range.maximum = range.minimum;
    }
  }
  return range;
}

DisparityRange CommonRange(
  const Camera& reference, const Camera& first, const Camera& second, const DisparityRange& within)
{
  constexpr int cells = 16;
  DisparityRange common{ std::numeric_limits<double>::infinity(), 0 };
  for (int row = 0; row <= cells; ++row)
  {
    for (int column = 0; column <= cells; ++column)
    {
      const Eigen::Vector2d pixel(
        column * reference.width / double(cells), row * reference.height / double(cells));
      const DisparityRange range =
        VisibleRange(reference, pixel, second, VisibleRange(reference, pixel, first, within));
      if (!range.Empty())
      {
        common.minimum = std::min(common.minimum, range.minimum);
        common.maximum = std::max(common.maximum, range.maximum);
      }
    }
  }
  return common;
}

}
