// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_CharucoDetection_h
#define freespace_CharucoDetection_h

#include "Calibration/BoardDetection.h"

#include <opencv2/core.hpp>

namespace freespace
{

/// DetectLayouts for a ChArUco board.
BoardDetection DetectCharuco(const cv::Mat& gray, const Board& board);

/// Corners with pixels in OpenCV's convention.
BoardCorners CornersFromOpenCV(const std::vector<int>& ids, const std::vector<cv::Point2f>& points);

}

#endif
