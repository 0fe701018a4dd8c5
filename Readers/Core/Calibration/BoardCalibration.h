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

/// Options of the calibration of cameras from images of a board (section 3: "a calibration grid").
struct BoardCalibrationOptions
{
  Board board;
  bool squarePixels = true;    ///< one focal length; else two
  int maximumCoefficients = 5; ///< of distortion: 0, 1 (k1), 2 (k2), 4 (p1 p2) or 5 (k3); fewer are
                               ///< used if the corners do not justify as many
  int minimumCorners = 8;      ///< of an image that is used
  double outlierThreshold = 4.0; ///< in standard deviations of the corners' errors; > 2

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// The result for one image.
struct BoardImage
{
  std::string file;           ///< path of the image
  bool used = false;          ///< whether the board was found and its pose was computed
  std::string reason;         ///< why not, as a clause
  BoardCorners corners;       ///< the inliers
  double error = 0;           ///< of their reprojection, root mean square in pixels
  CalibratedImage calibrated; ///< its camera in the frame of BoardPoints
  int cameraIndex = 0;        ///< images of one camera have the same
};

/// The result of a calibration. All images of one size are of one camera, unless those of several folders
/// are clearly of a camera for each.
struct BoardCalibration
{
  std::vector<BoardImage> images; ///< in the order of the files
  bool hasFormerLayout = false;   ///< of a ChArUco board, see BoardDetection
  double error = 0;               ///< of all corners, root mean square in pixels

  /// The used images as a sparse model whose points are the corners of the board. Images are named by
  /// their path relative to the folder.
  SparseModel Model(const Board& board, const std::string& folder) const;
};

/// Detects the board in every image and calibrates: the intrinsics with as many distortion coefficients
/// as the corners justify (by the Bayesian information criterion) and the pose of every image. Outliers
/// among the corners are rejected, and so are images without the board. Throws Error naming an image that
/// cannot be read, when fewer than three images of a size show the board, and for a chessboard that
/// looks the same when it is turned by half.
BoardCalibration CalibrateFromBoard(const std::vector<std::string>& files,
  const BoardCalibrationOptions& options, const ParallelFor& parallelFor = SerialFor,
  const Progress& progress = Progress());

}

#endif
