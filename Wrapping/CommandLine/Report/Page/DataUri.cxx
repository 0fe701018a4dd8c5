// SPDX-License-Identifier: BSD-3-Clause
#include "Report/Page/DataUri.h"

#include "Common/Error.h"
#include "Images/ImageCodecs.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace freespace
{

std::string Base64(const void* bytes, std::size_t count)
{
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto* data = static_cast<const unsigned char*>(bytes);
  std::string text;
  text.reserve((count + 2) / 3 * 4);
  for (std::size_t i = 0; i < count; i += 3)
  {
    const std::size_t here = std::min<std::size_t>(3, count - i);
    unsigned int group = data[i] << 16;
    group |= here > 1 ? data[i + 1] << 8 : 0;
    group |= here > 2 ? data[i + 2] : 0;
    text += digits[group >> 18];
    text += digits[group >> 12 & 63];
    text += here > 1 ? digits[group >> 6 & 63] : '=';
    text += here > 2 ? digits[group & 63] : '=';
  }
  return text;
}

InlinePicture InlinePictureFromFile(const std::string& file, int widest, int quality)
{
  cv::Mat picture;
  std::vector<unsigned char> jpeg;
  try
  {
    picture = ReadImageFile(file, cv::IMREAD_COLOR);
    if (!picture.empty())
    {
      if (picture.cols > widest)
      {
        const int height = std::max(1, cvRound(double(picture.rows) * widest / picture.cols));
        cv::resize(picture, picture, { widest, height }, 0, 0, cv::INTER_AREA);
      }
      jpeg = EncodeImage(".jpg", picture, { cv::IMWRITE_JPEG_QUALITY, quality });
    }
  }
  catch (const cv::Exception&)
  {
    jpeg.clear();
  }
  if (jpeg.empty())
  {
    throw Error("Cannot read " + file + " as a picture.");
  }
  return { "data:image/jpeg;base64," + Base64(jpeg), picture.cols, picture.rows };
}

}
