// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_UndistortedImage_h
#define freespace_UndistortedImage_h

#include "Images/CalibratedImage.h"

#include <opencv2/core.hpp>

namespace freespace
{

/// The pixels of an image as its pinhole camera would have taken them, without the lens's distortion. The
/// interpolation is OpenCV's.
cv::Mat Undistorted(const cv::Mat& pixels, const CalibratedImage& image, int interpolation);

/// Reads an image (8 bits, blue green red) as its pinhole camera would have taken it, without the
/// lens's distortion. Throws Error naming the file when it is missing, damaged or not of its
/// camera's size.
cv::Mat ReadUndistortedImage(const std::string& path, const CalibratedImage& image);

}

#endif
