// SPDX-License-Identifier: BSD-3-Clause
#include "VisibilityMap.h"

#include "Error.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace freespace
{

void VisibilityOptions::Check() const
{
  if (!(this->tolerance >= 0 && this->tolerance < 1))
  {
    throw Error("The tolerance of visibility must be at least 0 and less than 1.");
  }
  if (!(this->jump > 0) || !(this->feather >= 1) || !(this->least > 0 && this->least <= 1))
  {
    throw Error("An occlusion's jump must be positive, its feather at least a pixel, and the least "
                "confidence in (0, 1].");
  }
}

namespace
{

enum Side : unsigned char
{
  Smooth,
  NearSide,
  FarSide
};

// The strongest second difference across a pixel, along the row, the column and both diagonals.
Side SideOfJump(const DisparityImage& image, int column, int row, double jump)
{
  const double here = image.At(column, row);
  double lowest = 0;
  double highest = 0;
  double nearest = here;
  const int steps[4][2] = { { 1, 0 }, { 0, 1 }, { 1, 1 }, { 1, -1 } };
  for (const auto& step : steps)
  {
    const double before = image.At(column - step[0], row - step[1]);
    const double after = image.At(column + step[0], row + step[1]);
    const double second = before + after - 2 * here;
    lowest = std::min(lowest, second);
    highest = std::max(highest, second);
    nearest = std::max({ nearest, before, after });
  }
  if (highest > jump * nearest)
  {
    return FarSide;
  }
  return -lowest > jump * nearest ? NearSide : Smooth;
}

double BorderDistance(int column, int row, const DisparityImage& image)
{
  return std::min({ column, row, image.width - 1 - column, image.height - 1 - row });
}

}

double VisibilityMap::At(const Eigen::Vector2d& pixel, double depth) const
{
  const double x = pixel.x() - 0.5;
  const double y = pixel.y() - 0.5;
  const int width = this->disparity.width;
  if (!(depth > 0 && x >= 0 && y >= 0 && x < width - 1 && y < this->disparity.height - 1))
  {
    return 0;
  }
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(y);
  const double a = x - column;
  const double b = y - row;
  const std::size_t at = std::size_t(row) * width + column;
  const auto between = [&](const std::vector<float>& values)
  {
    return (1 - b) * ((1 - a) * values[at] + a * values[at + 1]) +
      b * ((1 - a) * values[at + width] + a * values[at + width + 1]);
  };
  const bool hidden = 1 < depth * between(this->disparity.values) * (1 - this->tolerance);
  return hidden ? 0 : between(this->confidence);
}

VisibilityMap MakeVisibilityMap(
  const TriangleMesh& mesh, const Camera& camera, const VisibilityOptions& options)
{
  options.Check();
  VisibilityMap map;
  map.tolerance = options.tolerance;
  map.disparity = RenderDisparity(mesh, camera);
  const DisparityImage& image = map.disparity;
  cv::Mat smooth(image.height, image.width, CV_8U, cv::Scalar(1));
  std::vector<Side> sides(image.values.size(), Smooth);
  for (int row = 1; row + 1 < image.height; ++row)
  {
    for (int column = 1; column + 1 < image.width; ++column)
    {
      const Side side = SideOfJump(image, column, row, options.jump);
      sides[std::size_t(row) * image.width + column] = side;
      smooth.at<unsigned char>(row, column) = side == Smooth;
    }
  }
  cv::Mat distance;
  cv::distanceTransform(smooth, distance, cv::DIST_L2, cv::DIST_MASK_5);
  map.confidence.resize(image.values.size());
  for (int row = 0; row < image.height; ++row)
  {
    for (int column = 0; column < image.width; ++column)
    {
      const std::size_t at = std::size_t(row) * image.width + column;
      const double inside = distance.at<float>(row, column) / options.feather;
      const double occlusion = std::clamp(inside, options.least, 1.0);
      const double border = std::min(1.0, BorderDistance(column, row, image) / options.feather);
      map.confidence[at] = sides[at] == FarSide ? 0.0f : static_cast<float>(occlusion * border);
    }
  }
  return map;
}

}
