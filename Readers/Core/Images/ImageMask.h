// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ImageMask_h
#define freespace_ImageMask_h

#include <opencv2/core.hpp>

#include <string>

namespace freespace
{

/// The mask of an image, one channel of 8 bits: 0 where the image is to be ignored. A mask of
/// another size is scaled. Empty when there is no such file. Throws Error naming the file when it is
/// damaged or of another shape.
cv::Mat LoadMask(const std::string& path, int width, int height);

}

#endif
