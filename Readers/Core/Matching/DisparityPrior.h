// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_DisparityPrior_h
#define freespace_DisparityPrior_h

#include <Eigen/Dense>

#include <vector>

namespace freespace
{

/// The disparity to expect in a part of an image: the median of the known matches in the same cell of a
/// coarse grid, or in the nearest cell that has any.
class DisparityPrior
{
public:
  DisparityPrior(
    const std::vector<Eigen::Vector2d>& pixels, const std::vector<double>& disparities);

  /// 0 if there are no known matches.
  double At(const Eigen::Vector2d& pixel) const;

private:
  static constexpr double CellSize = 16; // pixels

  int CellOf(const Eigen::Vector2d& pixel) const;
  void SpreadToEmptyCells();

  int Columns = 0;
  int Rows = 0;
  std::vector<double> Disparity; // per cell
};

}

#endif
