// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BoardDetection_h
#define freespace_BoardDetection_h

#include "Images/CalibratedImage.h"
#include "Scene/Scene.h"

#include <opencv2/core/mat.hpp>

#include <vector>

namespace freespace
{

/// The inner corners of a board as they were found in an image.
struct BoardCorners
{
  std::vector<int> ids;                ///< indices into BoardPoints
  std::vector<Eigen::Vector2d> pixels; ///< COLMAP's convention
};

/// The corners of a ChArUco board for both of its layouts: since OpenCV 4.6 the first square of a board
/// with an even number of rows is black, before it was white, as it still is on other makers' boards.
struct BoardDetection
{
  BoardCorners corners, formerCorners; ///< in the present and the former layout
  int markers = 0, formerMarkers = 0;  ///< that lie where the layout has them
};

/// All inner corners of a board, in its frame: x along the columns, y against the rows, z out of the
/// board towards who sees it, the origin in the middle of the board.
std::vector<Eigen::Vector3d> BoardPoints(const Board& board);

/// Finds a board in a grey image, in the layout that more of its markers fit. A ChArUco board may be partly hidden; of
/// a chessboard all inner corners must be seen. No corners mean that the board was not found. Throws Error for a
/// dictionary that does not exist or has too few markers.
BoardCorners DetectBoard(const cv::Mat& gray, const Board& board);

/// The same for both layouts: only all images together determine which one it is.
BoardDetection DetectLayouts(const cv::Mat& gray, const Board& board);

/// Once the camera is approximately known: all corners of the board that the image shows, also those whose
/// markers are hidden. A corner counts when the four squares about it look like it and when it is
/// found within a pixel and a half of where it should be.
BoardCorners FindBoardCorners(
  const cv::Mat& gray, const Board& board, const CalibratedImage& image);

/// The image with the corners drawn over it.
cv::Mat DrawBoardCorners(const cv::Mat& image, const BoardCorners& corners);

}

#endif
