// SPDX-License-Identifier: BSD-3-Clause
#include "UndistortedImage.h"

#include "Error.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <filesystem>

namespace freespace
{

cv::Mat ReadUndistortedImage(const std::string& path, const CalibratedImage& image)
{
  if (!std::filesystem::is_regular_file(path))
  {
    throw Error("Cannot read the image " + path + ": there is no such file.");
  }
  const cv::Mat read = cv::imread(path, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  if (read.empty())
  {
    throw Error("Cannot read the image " + path + ": it is damaged or of an unknown format.");
  }
  const Camera& camera = image.camera;
  if (read.cols != camera.width || read.rows != camera.height)
  {
    throw Error("The image " + path + " has " + std::to_string(read.cols) + " x " +
      std::to_string(read.rows) + " pixels, but its camera has " + std::to_string(camera.width) +
      " x " + std::to_string(camera.height) + ".");
  }
  if (image.distortion.empty())
  {
    return read;
  }
  // OpenCV's first pixel has its centre at 0, ours at 0.5.
  const Eigen::Matrix3d& K = camera.K;
  const cv::Matx33d intrinsics(K(0, 0), K(0, 1), K(0, 2) - 0.5, 0, K(1, 1), K(1, 2) - 0.5, 0, 0, 1);
  cv::Mat columns, rows, result;
  cv::initUndistortRectifyMap(
    intrinsics, image.distortion, cv::noArray(), intrinsics, read.size(), CV_32FC1, columns, rows);
  cv::remap(read, result, columns, rows, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  return result;
}

}
