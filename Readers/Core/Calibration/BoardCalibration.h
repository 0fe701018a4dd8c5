// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BoardCalibration_h
#define freespace_BoardCalibration_h

#include "Calibration/BoardDetection.h"
#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "SparseModel/SparseModel.h"

#include <string>
#include <vector>

namespace freespace
{

/// How cameras are calibrated from pictures of a board (section 3 of the paper: "a calibration grid").
struct BoardCalibrationOptions
{
  Board board;
  bool squarePixels = true;      ///< one focal length; else two
  int maximumCoefficients = 5;   ///< of distortion: 0, 1 (k1), 2 (k2), 4 (p1 p2) or 5 (k3). Fewer
                                 ///< are used where the corners do not call for more
  int minimumCorners = 8;        ///< of a picture that counts
  double outlierThreshold = 4.0; ///< in standard deviations of the corners' errors; > 2

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// What became of one picture.
struct BoardPicture
{
  std::string file;      ///< path of the picture
  bool used = false;     ///< whether the board was found and its pose could be had
  std::string reason;    ///< why not, as a clause
  BoardCorners corners;  ///< those that count
  double error = 0;      ///< of their reprojection, root mean square in pixels
  CalibratedImage image; ///< its camera in the frame of BoardPoints
};

/// All pictures of one size are taken to be one camera's.
struct BoardCalibration
{
  std::vector<BoardPicture> pictures; ///< in the order of the files
  double error = 0;                   ///< of all corners, root mean square in pixels

  /// The used pictures as a model; its points are the corners of the board. Images are named by their
  /// path relative to the folder.
  SparseModel Model(const Board& board, const std::string& folder) const;
};

/// Finds the board in every picture and calibrates: intrinsics with as much distortion as the corners
/// call for (the Bayesian information criterion decides) and the pose of every picture. Corners that do
/// not fit are dropped; so are pictures without the board. Throws Error naming a picture that cannot be
/// read, and when fewer than three pictures of a size show the board.
BoardCalibration CalibrateFromBoard(const std::vector<std::string>& files,
  const BoardCalibrationOptions& options, const ParallelFor& parallelFor = SerialFor,
  const Progress& progress = Progress());

/// Writes the used pictures with their corners drawn over them into a folder, which is made when only
/// its last part is missing, as .jpg files named after the pictures. Throws Error naming what cannot be
/// written.
void WriteBoardPictures(const BoardCalibration& calibration, const std::string& folder);

/// Board from a text such as "charuco:15x15:0.03:0.0225:DICT_5X5_250" (squares, their side, the
/// marker's side, dictionary) or "chessboard:9x6:0.025" (inner corners, side of a square). Throws Error.
Board BoardFromText(const std::string& text);

}

#endif
