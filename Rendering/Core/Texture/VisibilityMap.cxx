// SPDX-License-Identifier: BSD-3-Clause
#include "Texture/VisibilityMap.h"

#include "Common/Error.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace freespace
{

void VisibilityOptions::Check() const
{
  if (!(this->tolerance >= 0) || !(this->jump > 0) || !(this->margin >= 0) ||
    !(this->feather >= 1) || !(this->least > 0 && this->least <= 1))
  {
    throw Error("The tolerance of visibility must be at least 0, an occlusion's jump positive, its "
                "margin at least 0, its feather at least "
                "a pixel, and the least "
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
  const std::size_t corners[4] = { at, at + 1, at + width, at + width + 1 };
  const double parts[4] = { (1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b };
  const double factor = 1 - this->tolerance;
  double between = 0;
  double seen = 0;
  double seenOnSide = 0;
  bool masked = false;
  for (int i = 0; i < 4; ++i)
  {
    const double relative = depth * this->disparity.values[corners[i]];
    const double confident = parts[i] * this->confidence[corners[i]];
    between += parts[i] * relative;
    seen += confident;
    seenOnSide += relative * factor <= 1 && relative >= factor ? confident : 0;
    masked = masked || this->confidence[corners[i]] <= MaskedConfidence;
  }
  if (masked)
  {
    return seenOnSide;
  }
  return between * factor > 1 ? 0 : seen;
}

VisibilityMap MakeVisibilityMap(
  const TriangleMesh& mesh, const Camera& camera, const VisibilityOptions& options)
{
  options.Check();
  VisibilityMap map;
  const double focal = camera.FocalLength();
  map.tolerance = std::min(0.5, options.tolerance / focal);
  map.disparity = RenderDisparity(mesh, camera);
  const DisparityImage& image = map.disparity;
  cv::Mat noOcclusion(image.height, image.width, CV_8U, cv::Scalar(1));
  cv::Mat noFarSide(image.height, image.width, CV_8U, cv::Scalar(1));
  for (int row = 1; row + 1 < image.height; ++row)
  {
    for (int column = 1; column + 1 < image.width; ++column)
    {
      const Side side = SideOfJump(image, column, row, options.jump / focal);
      noOcclusion.at<unsigned char>(row, column) = side == Smooth;
      noFarSide.at<unsigned char>(row, column) = side != FarSide;
    }
  }
  cv::Mat toOcclusion, toFarSide;
  cv::distanceTransform(noOcclusion, toOcclusion, cv::DIST_L2, cv::DIST_MASK_5);
  cv::distanceTransform(noFarSide, toFarSide, cv::DIST_L2, cv::DIST_MASK_5);
  map.confidence.resize(image.values.size());
  for (int row = 0; row < image.height; ++row)
  {
    for (int column = 0; column < image.width; ++column)
    {
      const float occlusion = toOcclusion.at<float>(row, column);
      const float farSide = toFarSide.at<float>(row, column);
      // The near side is nearer to its own last pixels than to the far side's.
      const bool masked = farSide <= options.margin && farSide <= occlusion;
      const double inside = std::clamp(occlusion / options.feather, options.least, 1.0);
      const double border = std::min(1.0, BorderDistance(column, row, image) / options.feather);
      map.confidence[std::size_t(row) * image.width + column] =
        static_cast<float>(masked ? MaskedConfidence * border : inside * border);
    }
  }
  return map;
}

namespace
{

// Adds up the colours on the square ring around a pixel that are of its side and not masked.
int AddRing(const VisibilityMap& map, const Photograph& photograph, int column, int row, int radius,
  std::array<int, 3>& sum)
{
  const DisparityImage& image = map.disparity;
  const double nearest = image.At(column, row) * (1 + map.tolerance);
  int count = 0;
  for (int v = std::max(0, row - radius); v <= std::min(image.height - 1, row + radius); ++v)
  {
    const bool whole = v == row - radius || v == row + radius;
    for (int u = column - radius; u <= column + radius; u += whole ? 1 : 2 * radius)
    {
      const std::size_t at = std::size_t(v) * image.width + u;
      if (u >= 0 && u < image.width && map.confidence[at] > MaskedConfidence &&
        image.values[at] <= nearest)
      {
        for (int channel = 0; channel < 3; ++channel)
        {
          sum[channel] += photograph.rgb[3 * at + channel];
        }
        ++count;
      }
    }
  }
  return count;
}

}

void FillMasked(const VisibilityMap& map, Photograph& photograph)
{
  const int farthest = 6; // pixels; the margin is narrower
  const Photograph before = photograph;
  for (int row = 0; row < map.disparity.height; ++row)
  {
    for (int column = 0; column < map.disparity.width; ++column)
    {
      const std::size_t at = std::size_t(row) * map.disparity.width + column;
      const bool masked = map.confidence[at] > 0 && map.confidence[at] <= MaskedConfidence;
      for (int radius = 1; masked && radius <= farthest; ++radius)
      {
        std::array<int, 3> sum = { 0, 0, 0 };
        if (const int count = AddRing(map, before, column, row, radius, sum))
        {
          for (int channel = 0; channel < 3; ++channel)
          {
            photograph.rgb[3 * at + channel] = static_cast<unsigned char>(sum[channel] / count);
          }
          break;
        }
      }
    }
  }
}

}
