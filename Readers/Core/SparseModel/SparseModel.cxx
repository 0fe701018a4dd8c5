// SPDX-License-Identifier: BSD-3-Clause
#include "SparseModel/SparseModel.h"

#include "Common/Error.h"

#include <climits>
#include <cmath>
#include <unordered_map>

namespace freespace
{

namespace
{

Eigen::Matrix3d Intrinsics(double fx, double fy, double cx, double cy)
{
  Eigen::Matrix3d K;
  K << fx, 0, cx, 0, fy, cy, 0, 0, 1;
  return K;
}

void SetLens(const SparseCamera& from, CalibratedImage& to)
{
  const std::vector<double>& p = from.parameters;
  const std::size_t focalLengths = FocalLengths(from.model);
  to.camera.K = Intrinsics(p[0], p[focalLengths - 1], p[focalLengths], p[focalLengths + 1]);
  to.camera.width = static_cast<int>(from.width);
  to.camera.height = static_cast<int>(from.height);
  to.distortion.assign(p.begin() + static_cast<std::ptrdiff_t>(focalLengths + 2), p.end());
  if (focalLengths == 1 && !to.distortion.empty())
  {
    to.distortion.resize(4, 0.0); // k1 [k2] without p1 p2
  }
}

void SetPose(const SparseImage& from, CalibratedImage& to)
{
  const auto& [w, x, y, z] = from.rotation;
  to.camera.R = Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
  to.camera.t = from.translation;
}

}

std::string LensModelName(LensModel model)
{
  switch (model)
  {
    case LensModel::SimplePinhole:
      return "SIMPLE_PINHOLE";
    case LensModel::Pinhole:
      return "PINHOLE";
    case LensModel::SimpleRadial:
      return "SIMPLE_RADIAL";
    case LensModel::Radial:
      return "RADIAL";
    case LensModel::OpenCV:
      return "OPENCV";
    case LensModel::FullOpenCV:
      return "FULL_OPENCV";
  }
  throw Error("There is no camera model number " + std::to_string(static_cast<int>(model)) + ".");
}

std::size_t LensModelParameters(LensModel model)
{
  switch (model)
  {
    case LensModel::SimplePinhole:
      return 3;
    case LensModel::Pinhole:
    case LensModel::SimpleRadial:
      return 4;
    case LensModel::Radial:
      return 5;
    case LensModel::OpenCV:
      return 8;
    case LensModel::FullOpenCV:
      return 12;
  }
  throw Error("There is no camera model number " + std::to_string(static_cast<int>(model)) + ".");
}

std::size_t FocalLengths(LensModel model)
{
  const bool one = model == LensModel::SimplePinhole || model == LensModel::SimpleRadial ||
    model == LensModel::Radial;
  return one ? 1 : 2;
}

SparseTracks::SparseTracks(const SparseModel& model)
  : ofPoint(model.points.size())
  , pointOf(model.images.size())
{
  std::unordered_map<std::uint64_t, int> indices;
  indices.reserve(model.points.size());
  for (std::size_t i = 0; i < model.points.size(); ++i)
  {
    indices[model.points[i].id] = static_cast<int>(i);
  }
  for (std::size_t image = 0; image < model.images.size(); ++image)
  {
    const std::vector<SparseObservation>& observations = model.images[image].observations;
    this->pointOf[image].assign(observations.size(), -1);
    for (std::size_t i = 0; i < observations.size(); ++i)
    {
      const auto found = indices.find(observations[i].point);
      if (found != indices.end())
      {
        this->pointOf[image][i] = found->second;
        this->ofPoint[static_cast<std::size_t>(found->second)].push_back(
          { static_cast<int>(image), static_cast<int>(i) });
      }
    }
  }
}

std::string FaultOf(const SparseCamera& camera)
{
  if (camera.width < 1 || camera.height < 1 || camera.width > INT_MAX || camera.height > INT_MAX)
  {
    return "camera " + std::to_string(camera.id) + " has no usable width and height";
  }
  for (double parameter : camera.parameters)
  {
    if (!std::isfinite(parameter))
    {
      return "camera " + std::to_string(camera.id) + " has a parameter that is not finite";
    }
  }
  if (camera.parameters[0] <= 0 || camera.parameters[FocalLengths(camera.model) - 1] <= 0)
  {
    return "camera " + std::to_string(camera.id) + " has a focal length that is not positive";
  }
  return {};
}

std::string FaultOf(const SparseImage& image)
{
  double norm = 0;
  for (double q : image.rotation)
  {
    norm += q * q;
  }
  if (!std::isfinite(norm) || norm < 1e-12 || !image.translation.allFinite())
  {
    return "image " + std::to_string(image.id) + " has a pose that is no rotation and translation";
  }
  if (image.name.empty())
  {
    return "image " + std::to_string(image.id) + " has no name";
  }
  return {};
}

std::string FaultOf(const SparsePoint& point)
{
  return point.position.allFinite()
    ? std::string()
    : "point " + std::to_string(point.id) + " has a position that is not finite";
}

std::vector<CalibratedImage> CalibratedImages(const SparseModel& model)
{
  std::unordered_map<std::uint32_t, const SparseCamera*> cameras;
  for (const SparseCamera& camera : model.cameras)
  {
    cameras[camera.id] = &camera;
  }
  std::vector<CalibratedImage> images;
  images.reserve(model.images.size());
  for (const SparseImage& image : model.images)
  {
    const auto camera = cameras.find(image.camera);
    if (camera == cameras.end())
    {
      throw Error("The image " + image.name + " names an unknown camera, number " +
        std::to_string(image.camera) + ".");
    }
    CalibratedImage& calibrated = images.emplace_back();
    calibrated.file = image.name;
    SetLens(*camera->second, calibrated);
    SetPose(image, calibrated);
  }
  return images;
}

}
