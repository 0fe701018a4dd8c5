// SPDX-License-Identifier: BSD-3-Clause
// OpenCV's image codecs. Their library is loaded when the first image is read or written: it brings
// more than a hundred others, which take longer to load than most commands take to run.
#pragma once

#include <opencv2/core.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace freespace
{

// As cv::imread, cv::imdecode and cv::imencode. They throw Error where the library cannot be loaded
// and cv::Exception where OpenCV does; an image that cannot be decoded is empty.
cv::Mat ReadImageFile(const std::string& file, int flags);
cv::Mat DecodeImageBytes(const cv::Mat& bytes, int flags);
std::vector<std::uint8_t> EncodeImage(
  const std::string& extension, const cv::Mat& image, const std::vector<int>& parameters = {});

}
