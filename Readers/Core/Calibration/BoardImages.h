// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BoardImages_h
#define freespace_BoardImages_h

#include "Calibration/BoardCalibration.h"

#include <opencv2/core/mat.hpp>

#include <string>

namespace freespace
{

/// Reads an image as grey levels, without applying its orientation tag. Throws Error naming the file
/// when it is missing, truncated or not an image.
cv::Mat ReadGrayImage(const std::string& file);

/// Writes the used images with their corners drawn over them into a folder, as .jpg files named after
/// the images. The folder is created if only its last part is missing. Throws Error naming the file
/// that cannot be written.
void WriteBoardPictures(const BoardCalibration& calibration, const std::string& folder);

}

#endif
