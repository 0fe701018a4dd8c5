// SPDX-License-Identifier: BSD-3-Clause
#include "Images/UndistortedImage.h"

#include "Images/ImageFile.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace freespace
{

cv::Mat Undistorted(const cv::Mat& pixels, const CalibratedImage& image, int interpolation)
{
  if (image.distortion.empty())
  {
    return pixels;
  }
  // OpenCV's first pixel has its centre at 0, ours at 0.5.
  const Eigen::Matrix3d& K = image.camera.K;
  const cv::Matx33d intrinsics(K(0, 0), K(0, 1), K(0, 2) - 0.5, 0, K(1, 1), K(1, 2) - 0.5, 0, 0, 1);
  cv::Mat columns, rows, result;
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
