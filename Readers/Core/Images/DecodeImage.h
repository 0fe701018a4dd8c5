// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_DecodeImage_h
#define freespace_DecodeImage_h

#include <opencv2/core.hpp>

#include <string>

namespace freespace
{

/// The pixels of a file with 8 bits, blue, green and red or, unless `isColor`, grey; as they are stored,
/// whatever the file says about its orientation. Empty where the file is damaged or of an unknown format.
/// Throws Error naming the file when it is a JPEG that lost a part. See EightBits.
cv::Mat DecodeImage(const std::string& file, bool isColor);

/// Converts an image of more than 8 bits to 8 by the range of its values: cameras put 12 or 14 bits into
/// files of 16, and floating point images have 0 to 1, or the range of 8 or 16 bits. The range is the smallest of
/// these that holds all values; those below 0 and NaN are black. An image of 8 bits is returned as it is.
cv::Mat EightBits(const cv::Mat& image);

}

#endif
