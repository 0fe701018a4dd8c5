// SPDX-License-Identifier: BSD-3-Clause
#include "Images/DecodeImage.h"

#include "Files/FileExtension.h"
#include "Images/ImageCodecs.h"
#include "Text/WholeFile.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace freespace
{

namespace
{

// The value of white, given the maximum of an image.
double WhiteOf(double greatest, bool isReal)
{
  // Floating point values may exceed 1 a little, in highlights.
  constexpr double brightest = 2.0, eight = 255, twelve = 4095, fourteen = 16383, sixteen = 65535;
  if (isReal && greatest <= brightest)
  {
    return 1.0;
  }
  if (isReal && greatest <= eight)
  {
    return eight;
  }
  return greatest <= twelve ? twelve
    : greatest <= fourteen  ? fourteen
                            : std::max(greatest, sixteen);
}

// OpenCV converts the channels of a TIFF of floating point wrongly or not at all.
cv::Mat WithChannels(const cv::Mat& image, bool isColor)
{
  const int code = image.channels() == 4 ? (isColor ? cv::COLOR_BGRA2BGR : cv::COLOR_BGRA2GRAY)
    : image.channels() == 3              ? (isColor ? -1 : cv::COLOR_BGR2GRAY)
                                         : (isColor ? cv::COLOR_GRAY2BGR : -1);
  cv::Mat converted = image;
  if (code >= 0 && !image.empty())
  {
    cv::cvtColor(image, converted, code);
  }
  return converted;
}

}

cv::Mat EightBits(const cv::Mat& image)
{
  if (image.empty() || image.depth() == CV_8U)
  {
    return image;
  }
  const bool isReal = image.depth() == CV_32F || image.depth() == CV_64F;
  cv::Mat numbers;
  image.convertTo(numbers, CV_64F);
  double greatest = 0.0;
  numbers = numbers.reshape(1);
  for (int row = 0; row < numbers.rows; ++row)
  {
    double* values = numbers.ptr<double>(row);
    for (int i = 0; i < numbers.cols; ++i)
    {
      values[i] = std::isfinite(values[i]) ? std::max(values[i], 0.0) : 0.0;
      greatest = std::max(greatest, values[i]);
    }
  }
  cv::Mat bytes;
  numbers.convertTo(bytes, CV_8U, 255.0 / WhiteOf(greatest, isReal));
  return bytes.reshape(image.channels());
}

cv::Mat DecodeImage(const std::string& file, bool isColor)
{
  CheckWholeJPEG(file);
  try
  {
    const std::string ending = LowerCaseExtension(file);
    if (ending == ".tif" || ending == ".tiff")
    {
      return WithChannels(EightBits(ReadImageFile(file, cv::IMREAD_UNCHANGED)), isColor);
    }
    return EightBits(ReadImageFile(file,
      (isColor ? cv::IMREAD_COLOR : cv::IMREAD_GRAYSCALE) | cv::IMREAD_ANYDEPTH |
        cv::IMREAD_IGNORE_ORIENTATION));
  }
  catch (const cv::Exception&)
  {
    return {};
  }
}

}
