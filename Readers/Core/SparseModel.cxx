// SPDX-License-Identifier: BSD-3-Clause
#include "SparseModel.h"

#include "Error.h"

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

bool HasOneFocalLength(LensModel model)
{
  return model == LensModel::SimplePinhole || model == LensModel::SimpleRadial ||
    model == LensModel::Radial;
}

void SetLens(const SparseCamera& from, CalibratedImage& to)
{
  const std::vector<double>& p = from.parameters;
  const std::size_t focalLengths = HasOneFocalLength(from.model) ? 1 : 2;
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
