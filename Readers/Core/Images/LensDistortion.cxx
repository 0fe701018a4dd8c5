// SPDX-License-Identifier: BSD-3-Clause
#include "Images/LensDistortion.h"

#include <cmath>
#include <limits>

#include <opencv2/calib3d.hpp>

namespace freespace
{

namespace
{

cv::Matx33d MatrixOf(const Eigen::Matrix3d& k)
{
  return { k(0, 0), k(0, 1), k(0, 2), k(1, 0), k(1, 1), k(1, 2), k(2, 0), k(2, 1), k(2, 2) };
}

std::vector<cv::Point2d> ToOpenCV(const std::vector<Eigen::Vector2d>& pixels)
{
  std::vector<cv::Point2d> points;
  points.reserve(pixels.size());
  for (const Eigen::Vector2d& pixel : pixels)
  {
    points.emplace_back(pixel.x(), pixel.y());
  }
  return points;
}

std::vector<Eigen::Vector2d> FromOpenCV(const std::vector<cv::Point2d>& points)
{
  std::vector<Eigen::Vector2d> pixels;
  pixels.reserve(points.size());
  for (const cv::Point2d& point : points)
  {
    pixels.emplace_back(point.x, point.y);
  }
  return pixels;
}

// In units of the focal length, from the principal point.
std::vector<Eigen::Vector2d> Normalized(
  const Eigen::Matrix3d& K, const std::vector<Eigen::Vector2d>& pixels)
{
  const Eigen::Matrix3d inverse = K.inverse();
  std::vector<Eigen::Vector2d> points;
  points.reserve(pixels.size());
  for (const Eigen::Vector2d& pixel : pixels)
  {
    points.push_back((inverse * pixel.homogeneous()).hnormalized());
  }
  return points;
}

std::vector<Eigen::Vector2d> PixelsOf(
  const Eigen::Matrix3d& K, std::vector<Eigen::Vector2d> normalized)
{
  for (Eigen::Vector2d& point : normalized)
  {
    point = (K * point.homogeneous()).hnormalized();
  }
  return normalized;
}

// --- THIN_PRISM_FISHEYE: the angles to the axis along x and y, distorted as by a perspective lens

Eigen::Vector2d DistortAngles(const std::vector<double>& d, const Eigen::Vector2d& a)
{
  const double r2 = a.squaredNorm(), xy = a.x() * a.y();
  const double radial = 1 + r2 * (d[0] + r2 * (d[1] + r2 * (d[4] + r2 * d[5])));
  return { a.x() * radial + 2 * d[2] * xy + d[3] * (r2 + 2 * a.x() * a.x()) + d[6] * r2,
    a.y() * radial + 2 * d[3] * xy + d[2] * (r2 + 2 * a.y() * a.y()) + d[7] * r2 };
}

Eigen::Matrix2d DistortAnglesJacobian(const std::vector<double>& d, const Eigen::Vector2d& a)
{
  const double r2 = a.squaredNorm(), x = a.x(), y = a.y();
  const double radial = 1 + r2 * (d[0] + r2 * (d[1] + r2 * (d[4] + r2 * d[5])));
  const double slope = 2 * (d[0] + r2 * (2 * d[1] + r2 * (3 * d[4] + r2 * 4 * d[5]))); // / r
  Eigen::Matrix2d J;
  J << radial + slope * x * x + 2 * d[2] * y + 6 * d[3] * x + 2 * d[6] * x,
    slope * x * y + 2 * d[2] * x + 2 * d[3] * y + 2 * d[6] * y,
    slope * x * y + 2 * d[3] * y + 2 * d[2] * x + 2 * d[7] * x,
    radial + slope * y * y + 2 * d[3] * x + 6 * d[2] * y + 2 * d[7] * y;
  return J;
}

Eigen::Vector2d DistortThinPrism(const std::vector<double>& d, const Eigen::Vector2d& point)
{
  const double r = point.norm();
  return DistortAngles(d, r > 0 ? Eigen::Vector2d(point * (std::atan(r) / r)) : point);
}

Eigen::Vector2d UndistortThinPrism(const std::vector<double>& d, const Eigen::Vector2d& point)
{
  constexpr int most = 50;
  Eigen::Vector2d angles = point;
  for (int i = 0; i < most; ++i)
  {
    const Eigen::Vector2d step =
      DistortAnglesJacobian(d, angles).inverse() * (DistortAngles(d, angles) - point);
    angles -= step;
    if (!(step.norm() > 1e-15))
    {
      break;
    }
  }
  const double r = angles.norm();
  return r > 0 ? Eigen::Vector2d(angles * (std::tan(r) / r)) : angles;
}

// --- FOV (Devernay and Faugeras, 2001): r_d = atan(2 r tan(w / 2)) / w

double FieldOfViewFactor(double omega, double r)
{
  if (std::abs(omega) < 1e-6 || r < 1e-9)
  {
    return std::abs(omega) < 1e-6 ? 1 : 2 * std::tan(omega / 2) / omega;
  }
  return std::atan(2 * r * std::tan(omega / 2)) / (omega * r);
}

double InverseFieldOfViewFactor(double omega, double r)
{
  if (std::abs(omega) < 1e-6 || r < 1e-9)
  {
    return std::abs(omega) < 1e-6 ? 1 : omega / (2 * std::tan(omega / 2));
  }
  return std::tan(r * omega) / (2 * r * std::tan(omega / 2));
}

std::vector<Eigen::Vector2d> DistortNormalized(
  const CalibratedImage& image, std::vector<Eigen::Vector2d> points)
{
  for (Eigen::Vector2d& point : points)
  {
    point = image.lens == LensKind::FieldOfView
      ? Eigen::Vector2d(point * FieldOfViewFactor(image.distortion[0], point.norm()))
      : DistortThinPrism(image.distortion, point);
  }
  return points;
}

std::vector<Eigen::Vector2d> UndistortNormalized(
  const CalibratedImage& image, std::vector<Eigen::Vector2d> points)
{
  for (Eigen::Vector2d& point : points)
  {
    point = image.lens == LensKind::FieldOfView
      ? Eigen::Vector2d(point * InverseFieldOfViewFactor(image.distortion[0], point.norm()))
      : UndistortThinPrism(image.distortion, point);
  }
  return points;
}

// Solvers return a value even without a solution, and OpenCV's clamps the angle: a result is accepted only
// if it distorts back to the given pixel.
void RemoveUnseen(const CalibratedImage& image, const std::vector<Eigen::Vector2d>& pixels,
  std::vector<Eigen::Vector2d>& undistorted)
{
  static const double mostTangent = std::tan(largestPinholeAngle * 3.14159265358979323846 / 180);
  constexpr double mostError = 1e-6; // pixels
  const std::vector<Eigen::Vector2d> again = DistortPixels(image, undistorted);
  const std::vector<Eigen::Vector2d> normalized = Normalized(image.camera.K, undistorted);
  for (std::size_t i = 0; i < pixels.size(); ++i)
  {
    if (!(normalized[i].norm() <= mostTangent) || !((again[i] - pixels[i]).norm() <= mostError))
    {
      undistorted[i].setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }
}

}

std::vector<Eigen::Vector2d> UndistortPixels(
  const CalibratedImage& image, const std::vector<Eigen::Vector2d>& pixels)
{
  if (image.IsPinhole() || pixels.empty())
  {
    return pixels;
  }
  const cv::Matx33d matrix = MatrixOf(image.camera.K);
  const cv::TermCriteria criteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 50, 1e-10);
  std::vector<cv::Point2d> undistorted;
  if (image.lens == LensKind::Perspective)
  {
    cv::undistortPoints(
      ToOpenCV(pixels), undistorted, matrix, image.distortion, cv::noArray(), matrix, criteria);
    return FromOpenCV(undistorted);
  }
  std::vector<Eigen::Vector2d> result;
  if (image.lens == LensKind::Fisheye)
  {
    cv::fisheye::undistortPoints(
      ToOpenCV(pixels), undistorted, matrix, image.distortion, cv::noArray(), matrix, criteria);
    result = FromOpenCV(undistorted);
  }
  else
  {
    result =
      PixelsOf(image.camera.K, UndistortNormalized(image, Normalized(image.camera.K, pixels)));
  }
  RemoveUnseen(image, pixels, result);
  return result;
}

std::vector<Eigen::Vector2d> DistortPixels(
  const CalibratedImage& image, const std::vector<Eigen::Vector2d>& pixels)
{
  if (image.IsPinhole() || pixels.empty())
  {
    return pixels;
  }
  const cv::Matx33d matrix = MatrixOf(image.camera.K);
  const std::vector<Eigen::Vector2d> normalized = Normalized(image.camera.K, pixels);
  std::vector<cv::Point2d> distorted;
  switch (image.lens)
  {
    case LensKind::Perspective:
    {
      std::vector<cv::Point3d> points;
      for (const Eigen::Vector2d& point : normalized)
      {
        points.emplace_back(point.x(), point.y(), 1);
      }
      const cv::Vec3d none(0, 0, 0);
      cv::projectPoints(points, none, none, matrix, image.distortion, distorted);
      return FromOpenCV(distorted);
    }
    case LensKind::Fisheye:
      cv::fisheye::distortPoints(ToOpenCV(normalized), distorted, matrix, image.distortion);
      return FromOpenCV(distorted);
    case LensKind::ThinPrismFisheye:
    case LensKind::FieldOfView:
      break;
  }
  return PixelsOf(image.camera.K, DistortNormalized(image, normalized));
}

}
