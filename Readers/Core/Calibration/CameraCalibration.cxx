// SPDX-License-Identifier: BSD-3-Clause
#include "Calibration/CameraCalibration.h"

#include "Calibration/BoardImages.h"
#include "Common/Error.h"
#include "Common/ForEach.h"
#include "Common/Median.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <opencv2/calib3d.hpp>

namespace freespace
{

std::size_t CountCoefficients(const std::vector<double>& distortion)
{
  std::size_t count = distortion.size();
  while (count > 0 && distortion[count - 1] == 0)
  {
    --count;
  }
  return count;
}

double CameraFit::Criterion() const
{
  const auto n = static_cast<double>(this->corners);
  return n * std::log(std::max(this->squares, 1e-20) / n) + this->parameters * std::log(n);
}

CameraCalibration::CameraCalibration(std::vector<BoardImage*> images,
  const BoardCalibrationOptions& options, const ParallelFor& parallelFor)
  : Images(std::move(images))
  , Options(options)
  , Points(BoardPoints(options.board))
  , For(parallelFor)
  , Size(
      this->Images.front()->calibrated.camera.width, this->Images.front()->calibrated.camera.height)
{
}

void CameraCalibration::Run()
{
  // First a camera from the detected corners, then all corners that this camera predicts.
  this->DropOutliers(std::min(this->Options.maximumCoefficients, 2));
  for (int round = 0; round < 2; ++round)
  {
    this->FindCorners();
    this->DropOutliers(this->Options.maximumCoefficients);
  }
  this->Store(this->BestFit());
}

// A start that needs no particular view of the board: a lens of 40 degrees.
cv::Mat CameraCalibration::FirstGuess() const
{
  const double focal = 1.4 * std::max(this->Size.width, this->Size.height);
  return (cv::Mat_<double>(3, 3) << focal, 0, (this->Size.width - 1) / 2.0, 0, focal,
    (this->Size.height - 1) / 2.0, 0, 0, 1);
}

int CameraCalibration::Flags(int coefficients, bool squarePixels)
{
  int flags = cv::CALIB_USE_INTRINSIC_GUESS;
  flags |= squarePixels ? cv::CALIB_FIX_ASPECT_RATIO : 0;
  flags |= coefficients < 1 ? cv::CALIB_FIX_K1 : 0;
  flags |= coefficients < 2 ? cv::CALIB_FIX_K2 : 0;
  flags |= coefficients < 4 ? cv::CALIB_ZERO_TANGENT_DIST : 0;
  flags |= coefficients < 5 ? cv::CALIB_FIX_K3 : 0;
  return flags;
}

CameraCalibration::Fit CameraCalibration::Calibrate(int coefficients) const
{
  std::vector<std::vector<cv::Point3f>> world;
  std::vector<std::vector<cv::Point2f>> seen;
  for (const BoardImage* image : this->Images)
  {
    auto& worldPoints = world.emplace_back();
    auto& pixels = seen.emplace_back();
    for (std::size_t i = 0; i < image->corners.ids.size(); ++i)
    {
      const Eigen::Vector3f point =
        this->Points[static_cast<std::size_t>(image->corners.ids[i])].cast<float>();
      const Eigen::Vector2d& pixel = image->corners.pixels[i];
      worldPoints.emplace_back(point.x(), point.y(), point.z());
      pixels.emplace_back(static_cast<float>(pixel.x() - 0.5), static_cast<float>(pixel.y() - 0.5));
    }
  }
  Fit fit;
  cv::Mat matrix = this->FirstGuess();
  cv::Mat distortion = cv::Mat::zeros(1, 5, CV_64F);
  try
  {
    cv::calibrateCamera(world, seen, this->Size, matrix, distortion, fit.rotations,
      fit.translations, Flags(coefficients, this->Options.squarePixels),
      cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 200, 1e-12));
  }
  catch (const cv::Exception& error)
  {
    throw Error("Cannot calibrate: the images of the board are degenerate (" + error.err + ").");
  }
  fit.matrix = cv::Matx33d(matrix);
  if (!cv::checkRange(matrix) || !cv::checkRange(distortion) || !(fit.matrix(0, 0) > 0))
  {
    throw Error("Cannot calibrate: the images show the board from too few directions.");
  }
  fit.distortion.assign(distortion.ptr<double>(), distortion.ptr<double>() + 5);
  fit.parameters = (this->Options.squarePixels ? 3 : 4) + coefficients;
  Measure(world, seen, fit);
  return fit;
}

// Computes the reprojection errors.
void CameraCalibration::Measure(const std::vector<std::vector<cv::Point3f>>& world,
  const std::vector<std::vector<cv::Point2f>>& seen, Fit& fit)
{
  for (std::size_t i = 0; i < world.size(); ++i)
  {
    std::vector<cv::Point2f> projected;
    cv::projectPoints(
      world[i], fit.rotations[i], fit.translations[i], fit.matrix, fit.distortion, projected);
    auto& errors = fit.errors.emplace_back();
    for (std::size_t k = 0; k < projected.size(); ++k)
    {
      errors.push_back(cv::norm(projected[k] - seen[i][k]));
      fit.squares += errors.back() * errors.back();
    }
    fit.corners += errors.size();
  }
}

// The standard deviation, robustly: the median of a Rayleigh distribution is 1.177 standard
// deviations.
double CameraCalibration::Deviation(const Fit& fit)
{
  std::vector<double> all;
  for (const auto& errors : fit.errors)
  {
    all.insert(all.end(), errors.begin(), errors.end());
  }
  return Median(std::move(all)) / 1.177;
}

// Calibrates and drops the corners that do not fit, until all do.
void CameraCalibration::DropOutliers(int coefficients)
{
  for (int round = 0; round < 20; ++round)
  {
    this->DropImages();
    const Fit fit = this->Calibrate(coefficients);
    // An error below a hundredth of a pixel is never an outlier.
    const double limit = this->Options.outlierThreshold * std::max(Deviation(fit), 0.01);
    std::size_t dropped = 0;
    for (std::size_t i = 0; i < this->Images.size(); ++i)
    {
      dropped += Keep(this->Images[i]->corners, fit.errors[i], limit);
    }
    this->Store(fit);
    if (dropped == 0)
    {
      return;
    }
  }
}

// Keeps the corners whose error is within the limit and returns how many others there were.
std::size_t CameraCalibration::Keep(
  BoardCorners& corners, const std::vector<double>& errors, double limit)
{
  BoardCorners kept;
  for (std::size_t k = 0; k < errors.size(); ++k)
  {
    if (errors[k] <= limit)
    {
      kept.ids.push_back(corners.ids[k]);
      kept.pixels.push_back(corners.pixels[k]);
    }
  }
  const std::size_t dropped = errors.size() - kept.ids.size();
  corners = std::move(kept);
  return dropped;
}

// Drops the images in which too few corners are left.
void CameraCalibration::DropImages()
{
  const auto isPoor = [&](BoardImage* image)
  {
    if (static_cast<int>(image->corners.ids.size()) >= this->Options.minimumCorners &&
      !this->AreCollinear(image->corners))
    {
      return false;
    }
    image->used = false;
    image->reason = "only " + std::to_string(image->corners.ids.size()) +
      " corners of the board were found, or all in one line";
    return true;
  };
  this->Images.erase(
    std::remove_if(this->Images.begin(), this->Images.end(), isPoor), this->Images.end());
  if (this->Images.size() < 3)
  {
    throw Error("Cannot calibrate: the board was found in fewer than three images of " +
      std::to_string(this->Size.width) + " x " + std::to_string(this->Size.height) + " pixels.");
  }
}

bool CameraCalibration::AreCollinear(const BoardCorners& corners) const
{
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  const Eigen::Vector3d& first = this->Points[static_cast<std::size_t>(corners.ids[0])];
  for (int id : corners.ids)
  {
    const Eigen::Vector2d d = (this->Points[static_cast<std::size_t>(id)] - first).head<2>();
    scatter += d * d.transpose();
  }
  return scatter.determinant() < 1e-9 * scatter.trace() * scatter.trace();
}

void CameraCalibration::FindCorners()
{
  ForEach(this->For, this->Images.size(),
    [this](std::size_t i)
    {
      BoardImage& image = *this->Images[i];
      image.corners =
        FindBoardCorners(ReadGrayImage(image.file), this->Options.board, image.calibrated);
    });
}

// The fit with as many coefficients as the corners justify.
CameraCalibration::Fit CameraCalibration::BestFit() const
{
  Fit best;
  double least = std::numeric_limits<double>::infinity();
  for (int coefficients : { 0, 1, 2, 4, 5 })
  {
    if (coefficients > this->Options.maximumCoefficients)
    {
      break;
    }
    Fit fit = this->Calibrate(coefficients);
    const double criterion = fit.Criterion();
    if (criterion < least)
    {
      least = criterion;
      best = std::move(fit);
    }
  }
  return best;
}

// Stores the fit in the cameras of the images.
void CameraCalibration::Store(const Fit& fit)
{
  for (std::size_t i = 0; i < this->Images.size(); ++i)
  {
    BoardImage& image = *this->Images[i];
    Camera& camera = image.calibrated.camera;
    cv::Matx33d rotation;
    cv::Rodrigues(fit.rotations[i], rotation);
    for (int k = 0; k < 9; ++k)
    {
      camera.R(k / 3, k % 3) = rotation(k / 3, k % 3);
      camera.K(k / 3, k % 3) = fit.matrix(k / 3, k % 3);
    }
    camera.K(0, 2) += 0.5;
    camera.K(1, 2) += 0.5;
    for (int k = 0; k < 3; ++k)
    {
      camera.t[k] = fit.translations[i].at<double>(k);
    }
    image.calibrated.distortion = fit.distortion;
    if (CountCoefficients(fit.distortion) == 0)
    {
      image.calibrated.distortion.clear();
    }
    double squares = 0;
    for (double error : fit.errors[i])
    {
      squares += error * error;
    }
    image.error = std::sqrt(squares / std::max<std::size_t>(fit.errors[i].size(), 1));
  }
}

}
