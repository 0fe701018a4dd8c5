// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ImageFile_h
#define freespace_ImageFile_h

#include <opencv2/core.hpp>

#include <string>

namespace freespace
{

/// An image with 8 bits of blue, green and red. Throws Error naming the file when it is missing,
/// unreadable or of another size than its camera's.
cv::Mat LoadImage(const std::string& path, int width, int height);

}

#endif
