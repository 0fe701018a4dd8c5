// SPDX-License-Identifier: BSD-3-Clause
#include "Images/UndistortedImage.h"

#include "Images/ImageFile.h"
#include "Images/LensDistortion.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace freespace
{

namespace
{

// Where the lens shows each pixel of the pinhole camera, in OpenCV's count of pixels.
void LensMap(const CalibratedImage& image, const cv::Size& size, cv::Mat& columns, cv::Mat& rows)
{
  columns.create(size, CV_32FC1);
  rows.create(size, CV_32FC1);
  std::vector<Eigen::Vector2d> pixels(static_cast<std::size_t>(size.width));
  for (int row = 0; row < size.height; ++row)
  {
    for (int column = 0; column < size.width; ++column)
    {
      pixels[static_cast<std::size_t>(column)] = { column + 0.5, row + 0.5 };
    }
    const std::vector<Eigen::Vector2d> shown = DistortPixels(image, pixels);
    for (int column = 0; column < size.width; ++column)
    {
      const Eigen::Vector2d& pixel = shown[static_cast<std::size_t>(column)];
      columns.at<float>(row, column) = static_cast<float>(pixel.x() - 0.5);
      rows.at<float>(row, column) = static_cast<float>(pixel.y() - 0.5);
    }
  }
}

}

cv::Mat Undistorted(const cv::Mat& pixels, const CalibratedImage& image, int interpolation)
{
  if (image.IsPinhole())
  {
    return pixels;
  }
  cv::Mat columns, rows, result;
  if (image.lens != LensKind::Perspective)
  {
    LensMap(image, pixels.size(), columns, rows);
    cv::remap(pixels, result, columns, rows, interpolation, cv::BORDER_REPLICATE);
    return result;
  }
  // OpenCV's first pixel has its centre at 0, ours at 0.5.
  const Eigen::Matrix3d& K = image.camera.K;
  const cv::Matx33d intrinsics(K(0, 0), K(0, 1), K(0, 2) - 0.5, 0, K(1, 1), K(1, 2) - 0.5, 0, 0, 1);
  cv::initUndistortRectifyMap(intrinsics, image.distortion, cv::noArray(), intrinsics,
    pixels.size(), CV_32FC1, columns, rows);
  cv::remap(pixels, result, columns, rows, interpolation, cv::BORDER_REPLICATE);
  return result;
}

cv::Mat ReadUndistortedImage(const std::string& path, const CalibratedImage& image)
{
  return Undistorted(
    LoadImage(path, image.camera.width, image.camera.height), image, cv::INTER_CUBIC);
}

}
