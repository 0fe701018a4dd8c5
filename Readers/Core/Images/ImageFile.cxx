// SPDX-License-Identifier: BSD-3-Clause
#include "Files/PathChecks.h"
#include "Images/ImageFile.h"

#include "Common/Error.h"
#include "Images/DecodeImage.h"

#include <filesystem>

namespace freespace
{

cv::Mat LoadImage(const std::string& path, int width, int height)
{
  if (!IsFile(path))
  {
    throw Error("Cannot read the image " + path + ": there is no such file.");
  }
  // Cameras know the pixels as they are stored.
  cv::Mat image = DecodeImage(path, true);
  if (image.empty())
  {
    throw Error("Cannot read the image " + path + ": it is damaged or of an unknown format.");
  }
  if (image.cols != width || image.rows != height)
  {
    throw Error("The image " + path + " has " + std::to_string(image.cols) + " x " +
      std::to_string(image.rows) + " pixels, but its camera has " + std::to_string(width) + " x " +
      std::to_string(height) + ".");
  }
  return image;
}

}
