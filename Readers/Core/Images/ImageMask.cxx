// SPDX-License-Identifier: BSD-3-Clause
#include "Files/PathChecks.h"
#include "Images/ImageMask.h"

#include "Common/Error.h"
#include "Images/ImageCodecs.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <filesystem>

namespace freespace
{

cv::Mat LoadMask(const std::string& path, int width, int height)
{
  if (!IsThere(path))
  {
    return {};
  }
  cv::Mat mask;
  try
  {
    mask = ReadImageFile(path, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
  }
  catch (const cv::Exception&)
  {
    mask.release(); // told below
  }
  if (mask.empty())
  {
    throw Error("Cannot read the mask " + path + ": it is damaged or of an unknown format.");
  }
  if (mask.cols == width && mask.rows == height)
  {
    return mask;
  }
  constexpr double alike = 0.01;
  const double x = double(mask.cols) / width, y = double(mask.rows) / height;
  if (std::abs(x - y) > alike * x)
  {
    throw Error("The mask " + path + " has " + std::to_string(mask.cols) + " x " +
      std::to_string(mask.rows) + " pixels, another shape than its image of " +
      std::to_string(width) + " x " + std::to_string(height) + ".");
  }
  cv::Mat scaled;
  cv::resize(mask, scaled, cv::Size(width, height), 0, 0, cv::INTER_NEAREST);
  return scaled;
}

}
