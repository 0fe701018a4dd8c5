// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Chart_h
#define freespace_Chart_h

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace freespace
{

/// Triangles of a surface projected along one axis, and where their chart is in the atlas.
struct Chart
{
  int axis = 0;    ///< along which it is projected
  double sign = 1; ///< from which side
  std::vector<int> triangles;
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;
  int column = 0; ///< of its corner in the atlas, texels
  int row = 0;
  int width = 0;
  int height = 0;

  /// The two coordinates perpendicular to the axis; mirrored for one of the two signs so that no
  /// chart is.
  Eigen::Vector2d Flat(const Eigen::Vector3d& point) const
  {
    return { this->sign * point[(this->axis + 1) % 3], point[(this->axis + 2) % 3] };
  }
};

/// Calls visit(column, row) for the unit cells whose centres a triangle in the plane covers.
template <typename Visit>
void ForEachCell(const std::array<Eigen::Vector2d, 3>& corners, const Visit& visit)
{
  const double least = std::min({ corners[0].y(), corners[1].y(), corners[2].y() });
  const double most = std::max({ corners[0].y(), corners[1].y(), corners[2].y() });
  for (int row = static_cast<int>(std::ceil(least - 0.5)); row + 0.5 <= most; ++row)
  {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (int i = 0; i < 3; ++i)
    {
      const Eigen::Vector2d& a = corners[i];
      const Eigen::Vector2d& b = corners[(i + 1) % 3];
      if (std::min(a.y(), b.y()) <= row + 0.5 && std::max(a.y(), b.y()) >= row + 0.5 &&
        a.y() != b.y())
      {
        const double x = a.x() + (row + 0.5 - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
        low = std::min(low, x);
        high = std::max(high, x);
      }
    }
    for (int column = static_cast<int>(std::ceil(low - 0.5)); column + 0.5 <= high; ++column)
    {
      visit(column, row);
    }
  }
}

}

#endif
