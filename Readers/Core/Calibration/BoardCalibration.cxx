// SPDX-License-Identifier: BSD-3-Clause
#include "Calibration/BoardCalibration.h"

#include "Calibration/BoardImages.h"
#include "Calibration/CameraCalibration.h"
#include "Common/Error.h"
#include "Common/ForEach.h"

#include <algorithm>
#include <cmath>
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
      "A picture needs at least 4 corners, and the threshold of outliers must be above 2.");
  }
}

BoardCalibration CalibrateFromBoard(const std::vector<std::string>& files,
  const BoardCalibrationOptions& options, const ParallelFor& parallelFor, const Progress& progress)
{
  options.Check();
  BoardCalibration calibration;
  calibration.pictures.resize(files.size());
  ForEach(parallelFor, files.size(),
    [&](std::size_t i)
    {
      BoardPicture& picture = calibration.pictures[i];
      const cv::Mat gray = ReadGrayImage(files[i]);
      picture.file = files[i];
      picture.image.camera.width = gray.cols;
      picture.image.camera.height = gray.rows;
      picture.corners = DetectBoard(gray, options.board);
      picture.used = !picture.corners.ids.empty();
      picture.reason = picture.used ? "" : "the board was not found";
    });
  progress(0.5);
  std::map<std::pair<int, int>, std::vector<BoardPicture*>> cameras;
  for (BoardPicture& picture : calibration.pictures)
  {
    if (picture.used)
    {
      cameras[{ picture.image.camera.width, picture.image.camera.height }].push_back(&picture);
    }
  }
  if (cameras.empty())
  {
    throw Error("Cannot calibrate: the board was found in none of " + std::to_string(files.size()) +
      " pictures.");
  }
  // If a camera cannot be calibrated, its images are skipped; it is an error if none can.
  std::string fault;
  std::size_t calibrated = 0;
  for (const auto& camera : cameras)
  {
    try
    {
      CameraCalibration(camera.second, options, parallelFor).Run();
      ++calibrated;
    }
    catch (const Error& error)
    {
      fault = error.what();
      for (BoardPicture* picture : camera.second)
      {
        picture->used = false;
        picture->reason =
          picture->reason.empty() ? "its camera could not be calibrated" : picture->reason;
      }
    }
  }
  if (calibrated == 0)
  {
    throw Error(fault);
  }
  double squares = 0;
  std::size_t corners = 0;
  for (const BoardPicture& picture : calibration.pictures)
  {
    const std::size_t own = picture.used ? picture.corners.ids.size() : 0;
    squares += picture.error * picture.error * static_cast<double>(own);
    corners += own;
  }
  calibration.error = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(corners, 1)));
  progress(1.0);
  return calibration;
}

}
