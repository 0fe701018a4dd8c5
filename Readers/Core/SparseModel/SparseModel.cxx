// SPDX-License-Identifier: BSD-3-Clause
#include "SparseModel/SparseModel.h"

#include "Common/Error.h"

#include <algorithm>
#include <cctype>
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

// What is to be known of a camera model.
struct LensModelTraits
{
  LensModel model;
  const char* name;
  LensKind kind;
  std::size_t focalLengths;
  std::size_t coefficients; // of distortion
};

constexpr LensModelTraits lensModels[] = {
  { LensModel::SimplePinhole, "SIMPLE_PINHOLE", LensKind::Perspective, 1, 0 },
  { LensModel::Pinhole, "PINHOLE", LensKind::Perspective, 2, 0 },
  { LensModel::SimpleRadial, "SIMPLE_RADIAL", LensKind::Perspective, 1, 1 },
  { LensModel::Radial, "RADIAL", LensKind::Perspective, 1, 2 },
  { LensModel::OpenCV, "OPENCV", LensKind::Perspective, 2, 4 },
  { LensModel::OpenCVFisheye, "OPENCV_FISHEYE", LensKind::Fisheye, 2, 4 },
  { LensModel::FullOpenCV, "FULL_OPENCV", LensKind::Perspective, 2, 8 },
  { LensModel::FieldOfView, "FOV", LensKind::FieldOfView, 2, 1 },
  { LensModel::SimpleRadialFisheye, "SIMPLE_RADIAL_FISHEYE", LensKind::Fisheye, 1, 1 },
  { LensModel::RadialFisheye, "RADIAL_FISHEYE", LensKind::Fisheye, 1, 2 },
  { LensModel::ThinPrismFisheye, "THIN_PRISM_FISHEYE", LensKind::ThinPrismFisheye, 2, 8 },
};

const LensModelTraits& TraitsOf(LensModel model)
{
  for (const LensModelTraits& traits : lensModels)
  {
    if (traits.model == model)
    {
      return traits;
    }
  }
  throw Error("There is no camera model number " + std::to_string(static_cast<int>(model)) + ".");
}

void SetLens(const SparseCamera& from, CalibratedImage& to)
{
  const std::vector<double>& p = from.parameters;
  const LensModelTraits& traits = TraitsOf(from.model);
  const std::size_t focal = traits.focalLengths;
  to.camera.K = Intrinsics(p[0], p[focal - 1], p[focal], p[focal + 1]);
  to.camera.width = static_cast<int>(from.width);
  to.camera.height = static_cast<int>(from.height);
  to.lens = traits.kind;
  to.distortion.assign(p.begin() + static_cast<std::ptrdiff_t>(focal + 2), p.end());
  if (focal == 1 && !to.distortion.empty())
  {
    to.distortion.resize(4, 0.0); // k1 [k2] without p1 p2 or k3 k4
  }
}

void SetPose(const SparseImage& from, CalibratedImage& to)
{
  const auto& [w, x, y, z] = from.rotation;
  to.camera.R =
    from.matrix.value_or(Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix());
  to.camera.t = from.translation;
}

}

std::string LensModelName(LensModel model)
{
  return TraitsOf(model).name;
}

std::optional<LensModel> LensModelOf(std::string_view name)
{
  for (const LensModelTraits& traits : lensModels)
  {
    if (traits.name == name)
    {
      return traits.model;
    }
  }
  return std::nullopt;
}

std::optional<LensModel> LensModelOf(int number)
{
  for (const LensModelTraits& traits : lensModels)
  {
    if (static_cast<int>(traits.model) == number)
    {
      return traits.model;
    }
  }
  return std::nullopt;
}

std::string UnsupportedLens(std::string_view name)
{
  std::string small(name.substr(0, 40));
  std::transform(small.begin(), small.end(), small.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  for (const char* panorama : { "equirectangular", "spherical", "panorama" })
  {
    if (small.find(panorama) != std::string::npos)
    {
      return "equirectangular images (" + std::string(name.substr(0, 40)) +
        ") are not supported: cut them into perspective ones first, with COLMAP's panorama_sfm.py "
        "or AliceVision's split360Images";
    }
  }
  std::string list;
  for (const LensModelTraits& traits : lensModels)
  {
    list += (list.empty() ? "" : ", ") + std::string(traits.name);
  }
  return "the camera model " + std::string(name.substr(0, 40)) + " is not supported; " + list +
    " are";
}

std::size_t LensModelParameters(LensModel model)
{
  const LensModelTraits& traits = TraitsOf(model);
  return traits.focalLengths + 2 + traits.coefficients;
}

std::size_t FocalLengths(LensModel model)
{
  return TraitsOf(model).focalLengths;
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

CalibratedImage CalibratedImageOf(const SparseImage& image, const SparseCamera& camera)
{
  CalibratedImage calibrated;
  calibrated.file = image.name;
  SetLens(camera, calibrated);
  SetPose(image, calibrated);
  return calibrated;
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
    images.push_back(CalibratedImageOf(image, *camera->second));
  }
  return images;
}

}
