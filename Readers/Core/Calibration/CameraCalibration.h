// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_CameraCalibration_h
#define freespace_CameraCalibration_h

#include "Calibration/BoardCalibration.h"

#include <opencv2/core.hpp>

#include <vector>

namespace freespace
{

/// How well a camera explains its images of a board.
struct CameraFit
{
  double squares = 0; ///< sum of the squared errors
  std::size_t corners = 0;
  int parameters = 0;

  /// The Bayesian information criterion: the less the better. The errors of the x and y of a corner are
  /// dependent: it counts as one observation.
  double Criterion() const;
};

/// Calibrates one camera from its images of a board: a fit with cv::calibrateCamera, rejection of
/// outliers, a second detection guided by the fit, and the choice of the number of distortion
/// coefficients by the Bayesian information criterion. Pixels in here follow OpenCV's convention.
class CameraCalibration
{
public:
  /// The images have the same size and corners. Keeps references to the images and the options.
  CameraCalibration(std::vector<BoardImage*> images, const BoardCalibrationOptions& options,
    const ParallelFor& parallelFor);

  /// Stores the camera, the pose, the corners that fit and their error in each image; marks the
  /// images in which too few corners are left as not used. Throws Error when fewer than three are
  /// left or when they do not determine a camera.
  void Run();

  /// The fit to the corners that the images have, none of which is dropped. Throws Error like Run.
  CameraFit Summary() const { return this->BestFit(); }

private:
  struct Fit : CameraFit
  {
    cv::Matx33d matrix;
    std::vector<double> distortion;
    std::vector<cv::Mat> rotations, translations;
    std::vector<std::vector<double>> errors; // per image and corner, pixels
  };

  cv::Mat FirstGuess() const;
  static int Flags(int coefficients, bool squarePixels);
  Fit Calibrate(int coefficients) const;
  static void Measure(const std::vector<std::vector<cv::Point3f>>& world,
    const std::vector<std::vector<cv::Point2f>>& seen, Fit& fit);
  static double Deviation(const Fit& fit);
  void DropOutliers(int coefficients);
  static std::size_t Keep(BoardCorners& corners, const std::vector<double>& errors, double limit);
  void DropImages();
  bool AreCollinear(const BoardCorners& corners) const;
  void FindCorners();
  Fit BestFit() const;
  void Store(const Fit& fit);

  std::vector<BoardImage*> Images;
  const BoardCalibrationOptions& Options;
  std::vector<Eigen::Vector3d> Points;
  const ParallelFor& For;
  cv::Size Size;
};

/// The number of distortion coefficients without trailing zeros.
std::size_t CountCoefficients(const std::vector<double>& distortion);

}

#endif
