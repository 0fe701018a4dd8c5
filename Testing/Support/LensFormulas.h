// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_LensFormulas_h
#define freespace_LensFormulas_h

#include "SparseModel/SparseModel.h"

#include <cmath>

namespace freespace
{

/// Where a lens shows a point of camera coordinates, pixels, by the formulas that COLMAP's documentation and
/// OpenCV's give for each camera model, written down one by one.
inline Eigen::Vector2d ShowByFormula(const SparseCamera& camera, const Eigen::Vector3d& point)
{
  const std::vector<double>& p = camera.parameters;
  const double u = point.x() / point.z(), v = point.y() / point.z();
  const double r = std::hypot(u, v),
               theta = std::atan2(std::hypot(point.x(), point.y()), point.z());
  const double r2 = r * r, t2 = theta * theta;
  const double a = r > 0 ? theta / r : 1; // fisheye: the point at the distance theta
  const auto pixel = [&](double x, double y, std::size_t focal)
  { return Eigen::Vector2d(p[0] * x + p[focal], p[focal - 1] * y + p[focal + 1]); };
  switch (camera.model)
  {
    case LensModel::SimplePinhole:
      return pixel(u, v, 1);
    case LensModel::Pinhole:
      return pixel(u, v, 2);
    case LensModel::SimpleRadial:
      return pixel(u * (1 + p[3] * r2), v * (1 + p[3] * r2), 1);
    case LensModel::Radial:
    {
      const double k = 1 + p[3] * r2 + p[4] * r2 * r2;
      return pixel(u * k, v * k, 1);
    }
    case LensModel::OpenCV:
    {
      const double k = 1 + p[4] * r2 + p[5] * r2 * r2;
      return pixel(u * k + 2 * p[6] * u * v + p[7] * (r2 + 2 * u * u),
        v * k + 2 * p[7] * u * v + p[6] * (r2 + 2 * v * v), 2);
    }
    case LensModel::FullOpenCV:
    {
      const double k = (1 + p[4] * r2 + p[5] * r2 * r2 + p[8] * r2 * r2 * r2) /
        (1 + p[9] * r2 + p[10] * r2 * r2 + p[11] * r2 * r2 * r2);
      return pixel(u * k + 2 * p[6] * u * v + p[7] * (r2 + 2 * u * u),
        v * k + 2 * p[7] * u * v + p[6] * (r2 + 2 * v * v), 2);
    }
    case LensModel::SimpleRadialFisheye:
      return pixel(a * u * (1 + p[3] * t2), a * v * (1 + p[3] * t2), 1);
    case LensModel::RadialFisheye:
    {
      const double k = 1 + p[3] * t2 + p[4] * t2 * t2;
      return pixel(a * u * k, a * v * k, 1);
    }
    case LensModel::OpenCVFisheye:
    {
      const double k =
        1 + p[4] * t2 + p[5] * std::pow(t2, 2) + p[6] * std::pow(t2, 3) + p[7] * std::pow(t2, 4);
      return pixel(a * u * k, a * v * k, 2);
    }
    case LensModel::ThinPrismFisheye:
    {
      const double x = a * u, y = a * v;
      const double k =
        1 + p[4] * t2 + p[5] * std::pow(t2, 2) + p[8] * std::pow(t2, 3) + p[9] * std::pow(t2, 4);
      return pixel(x * k + 2 * p[6] * x * y + p[7] * (t2 + 2 * x * x) + p[10] * t2,
        y * k + 2 * p[7] * x * y + p[6] * (t2 + 2 * y * y) + p[11] * t2, 2);
    }
    case LensModel::FieldOfView:
    {
      const double k = r > 0 ? std::atan(r * 2 * std::tan(p[4] / 2)) / (r * p[4]) : 1;
      return pixel(u * k, v * k, 2);
    }
  }
  return {};
}

/// A camera of a model with every parameter in use.
inline SparseCamera CameraWithLens(LensModel model)
{
  SparseCamera camera{ 3, model, 800, 600, { 400, 405, 398.5, 301.25 } };
  if (FocalLengths(model) == 1)
  {
    camera.parameters = { 400, 398.5, 301.25 };
  }
  const std::size_t given = camera.parameters.size();
  std::vector<double> more = { -0.02, 0.003, 0.0007, -0.0004, 0.0003, 0.001, -0.0006, 0.0002 };
  if (model == LensModel::OpenCVFisheye)
  {
    more = { -0.02, 0.003, -0.001, 0.0002 };
  }
  if (model == LensModel::FieldOfView)
  {
    more = { 0.9 };
  }
  camera.parameters.insert(camera.parameters.end(), more.begin(),
    more.begin() + static_cast<std::ptrdiff_t>(LensModelParameters(model) - given));
  return camera;
}

constexpr LensModel everyLensModel[] = { LensModel::SimplePinhole, LensModel::Pinhole,
  LensModel::SimpleRadial, LensModel::Radial, LensModel::OpenCV, LensModel::OpenCVFisheye,
  LensModel::FullOpenCV, LensModel::FieldOfView, LensModel::SimpleRadialFisheye,
  LensModel::RadialFisheye, LensModel::ThinPrismFisheye };

}

#endif
