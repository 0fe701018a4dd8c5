// SPDX-License-Identifier: BSD-3-Clause
#include "Calibration/BoardCalibration.h"

#include "Calibration/BoardImages.h"
#include "Calibration/CameraCalibration.h"
#include "Common/Error.h"
#include "Common/ForEach.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>

namespace freespace
{

void BoardCalibrationOptions::Check() const
{
  this->board.Check();
  if (this->maximumCoefficients < 0 || this->maximumCoefficients > 5 ||
    this->maximumCoefficients == 3)
  {
    throw Error("The number of coefficients of distortion must be 0, 1, 2, 4 or 5.");
  }
  if (this->minimumCorners < 4 || !(this->outlierThreshold > 2))
  {
    throw Error(
      "An image needs at least 4 corners, and the threshold of outliers must be above 2.");
  }
}

namespace
{

using Images = std::vector<BoardImage*>;

// Squares of an even sum of sides look the same when the board is turned by half.
void CheckTellsItsSides(const Board& board)
{
  if (board.kind == Board::Kind::Chessboard && (board.columns + board.rows) % 2 == 0)
  {
    throw Error("Cannot calibrate: a chessboard of " + std::to_string(board.columns) + " x " +
      std::to_string(board.rows) +
      " inner corners looks the same when it is turned by half, so that the cameras' poses are not "
      "known: one of the numbers must be even and the other odd.");
  }
}

// Detects the board in all images. Of a ChArUco board's two layouts the one counts that more markers of
// all images fit.
void Detect(const std::vector<std::string>& files, const Board& board,
  const ParallelFor& parallelFor, BoardCalibration& calibration)
{
  std::vector<BoardDetection> detections(files.size());
  ForEach(parallelFor, files.size(),
    [&](std::size_t i)
    {
      BoardImage& image = calibration.images[i];
      const cv::Mat gray = ReadGrayImage(files[i]);
      image.file = files[i];
      image.calibrated.camera.width = gray.cols;
      image.calibrated.camera.height = gray.rows;
      detections[i] = DetectLayouts(gray, board);
    });
  int markers = 0, formerMarkers = 0;
  for (const BoardDetection& detection : detections)
  {
    markers += detection.markers;
    formerMarkers += detection.formerMarkers;
  }
  calibration.hasFormerLayout = formerMarkers > markers;
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    BoardImage& image = calibration.images[i];
    image.corners =
      std::move(calibration.hasFormerLayout ? detections[i].formerCorners : detections[i].corners);
    image.used = !image.corners.ids.empty();
    image.reason = image.used ? "" : "the board was not found";
  }
}

// The images of one size, by the folders that they are in.
std::vector<Images> ByFolder(const Images& images)
{
  std::map<std::string, Images> folders;
  for (BoardImage* image : images)
  {
    folders[std::filesystem::path(image->file).parent_path().string()].push_back(image);
  }
  std::vector<Images> groups;
  for (auto& folder : folders)
  {
    groups.push_back(std::move(folder.second));
  }
  return groups;
}

// Whether images of several folders are better explained by a camera for each folder than by one, by the
// Bayesian information criterion over the corners that fit the folders' own cameras.
bool HaveOwnCameras(const std::vector<Images>& folders, const BoardCalibrationOptions& options,
  const ParallelFor& parallelFor)
{
  std::vector<BoardImage> copies;
  for (const Images& folder : folders)
  {
    for (const BoardImage* image : folder)
    {
      copies.push_back(*image);
    }
  }
  CameraFit apart;
  Images all;
  std::size_t next = 0;
  for (const Images& folder : folders)
  {
    Images own;
    for (std::size_t i = 0; i < folder.size(); ++i)
    {
      own.push_back(&copies[next++]);
    }
    CameraCalibration calibration(own, options, parallelFor);
    calibration.Run();
    const CameraFit fit = calibration.Summary();
    apart.squares += fit.squares;
    apart.corners += fit.corners;
    apart.parameters += fit.parameters;
    std::copy_if(own.begin(), own.end(), std::back_inserter(all),
      [](const BoardImage* image) { return image->used; });
  }
  const CameraFit together = CameraCalibration(all, options, parallelFor).Summary();
  return apart.Criterion() < together.Criterion();
}

// All images of one size are of one camera, unless those of different folders are clearly of several.
std::vector<Images> CamerasOf(
  const Images& images, const BoardCalibrationOptions& options, const ParallelFor& parallelFor)
{
  std::vector<Images> folders = ByFolder(images);
  try
  {
    if (folders.size() > 1 && HaveOwnCameras(folders, options, parallelFor))
    {
      return folders;
    }
  }
  catch (const Error&)
  {
    // A folder does not determine a camera by itself.
  }
  return { images };
}

}

BoardCalibration CalibrateFromBoard(const std::vector<std::string>& files,
  const BoardCalibrationOptions& options, const ParallelFor& parallelFor, const Progress& progress)
{
  options.Check();
  CheckTellsItsSides(options.board);
  BoardCalibration calibration;
  calibration.images.resize(files.size());
  Detect(files, options.board, parallelFor, calibration);
  progress(0.5);
  std::map<std::pair<int, int>, Images> sizes;
  for (BoardImage& image : calibration.images)
  {
    if (image.used)
    {
      sizes[{ image.calibrated.camera.width, image.calibrated.camera.height }].push_back(&image);
    }
  }
  if (sizes.empty())
  {
    throw Error("Cannot calibrate: the board was found in none of " + std::to_string(files.size()) +
      " images.");
  }
  std::vector<Images> cameras;
  for (const auto& size : sizes)
  {
    for (Images& camera : CamerasOf(size.second, options, parallelFor))
    {
      cameras.push_back(std::move(camera));
    }
  }
  // If a camera cannot be calibrated, its images are skipped; it is an error if none can.
  std::string fault;
  std::size_t calibrated = 0;
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    try
    {
      CameraCalibration(cameras[i], options, parallelFor).Run();
      ++calibrated;
    }
    catch (const Error& error)
    {
      fault = error.what();
      for (BoardImage* image : cameras[i])
      {
        image->used = false;
        image->reason =
          image->reason.empty() ? "its camera could not be calibrated" : image->reason;
      }
    }
    for (BoardImage* image : cameras[i])
    {
      image->cameraIndex = static_cast<int>(i);
    }
  }
  if (calibrated == 0)
  {
    throw Error(fault);
  }
  double squares = 0;
  std::size_t corners = 0;
  for (const BoardImage& image : calibration.images)
  {
    const std::size_t own = image.used ? image.corners.ids.size() : 0;
    squares += image.error * image.error * static_cast<double>(own);
    corners += own;
  }
  calibration.error = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(corners, 1)));
  progress(1.0);
  return calibration;
}

}
