// SPDX-License-Identifier: BSD-3-Clause
#include "Silhouettes/MaskTriangles.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <iterator>
#include <vector>

namespace freespace
{

using Eigen::Vector2d;

namespace
{

constexpr std::size_t LongestStraight = 16; // pixels

// 255 where the pixel and its eight neighbours are black; beyond the image everything is.
cv::Mat InnerBlack(const cv::Mat& mask)
{
  const cv::Mat black = mask == 0;
  cv::Mat inner;
  cv::erode(black, inner, cv::Mat(), cv::Point(-1, -1), 1, cv::BORDER_CONSTANT, cv::Scalar(255));
  return inner;
}

// The corners of a contour of neighbouring pixels, and points between them.
Outline OutlineOf(const std::vector<cv::Point>& pixels)
{
  Outline outline;
  const std::size_t count = pixels.size();
  std::size_t last = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const cv::Point before = pixels[i] - pixels[(i + count - 1) % count];
    const cv::Point after = pixels[(i + 1) % count] - pixels[i];
    if (i == 0 || before != after || i - last == LongestStraight)
    {
      outline.emplace_back(pixels[i].x + 0.5, pixels[i].y + 0.5);
      last = i;
    }
  }
  return outline;
}

}

PlanarTriangles MaskTriangles(const cv::Mat& mask)
{
  const cv::Mat inner = InnerBlack(mask);
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(inner, contours, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
  std::vector<Outline> outlines;
  outlines.reserve(contours.size());
  std::transform(contours.begin(), contours.end(), std::back_inserter(outlines), OutlineOf);
  // The contours run through the centres of black pixels.
  return TriangulateOutlines(outlines,
    [&inner](const Vector2d& point)
    {
      const int column = std::clamp(static_cast<int>(point.x()), 0, inner.cols - 1);
      const int row = std::clamp(static_cast<int>(point.y()), 0, inner.rows - 1);
      return inner.at<unsigned char>(row, column) != 0;
    });
}

}
