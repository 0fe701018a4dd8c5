// SPDX-License-Identifier: BSD-3-Clause
#include "SparseModel/ModelBuilder.h"

#include "Common/Error.h"

#include <utility>

namespace freespace
{

SparseCamera PerspectiveCamera(
  double fx, double fy, double cx, double cy, std::vector<double> distortion)
{
  while (!distortion.empty() && distortion.back() == 0)
  {
    distortion.pop_back();
  }
  const std::size_t count = distortion.size();
  distortion.resize(8, 0.0);
  SparseCamera camera;
  if (fx == fy && count <= 2)
  {
    constexpr LensModel models[] = { LensModel::SimplePinhole, LensModel::SimpleRadial,
      LensModel::Radial };
    camera.model = models[count];
    camera.parameters = { fx, cx, cy };
  }
  else
  {
    camera.model = count == 0 ? LensModel::Pinhole
      : count <= 4            ? LensModel::OpenCV
                              : LensModel::FullOpenCV;
    camera.parameters = { fx, fy, cx, cy };
  }
  camera.parameters.insert(camera.parameters.end(), distortion.begin(), distortion.end());
  camera.parameters.resize(LensModelParameters(camera.model));
  return camera;
}

ModelBuilder::ModelBuilder(std::string file, const std::string& folder)
  : File(std::move(file))
{
  this->Model.folder = folder;
}

void ModelBuilder::Fail(const std::string& fault) const
{
  throw Error("Cannot read " + this->File + ": " + fault + ".");
}

void ModelBuilder::FailOn(const std::string& fault) const
{
  if (!fault.empty())
  {
    this->Fail(fault);
  }
}

std::uint32_t ModelBuilder::AddCamera(SparseCamera camera)
{
  std::vector<double> key = { static_cast<double>(camera.model), static_cast<double>(camera.width),
    static_cast<double>(camera.height) };
  key.insert(key.end(), camera.parameters.begin(), camera.parameters.end());
  camera.id = static_cast<std::uint32_t>(this->Model.cameras.size() + 1);
  this->FailOn(FaultOf(camera)); // so that the key has no NaN
  const auto [known, isNew] = this->Cameras.emplace(std::move(key), camera.id);
  if (isNew)
  {
    this->Model.cameras.push_back(std::move(camera));
  }
  return known->second;
}

std::uint32_t ModelBuilder::AddImage(const std::string& name, std::uint32_t camera,
  const Eigen::Matrix3d& rotation, const Eigen::Vector3d& center)
{
  constexpr double rounding = 1e-3;
  SparseImage image;
  image.id = static_cast<std::uint32_t>(this->Model.images.size() + 1);
  image.name = name;
  image.camera = camera;
  const double deviation = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm();
  if (!(deviation < rounding) || !(rotation.determinant() > 0))
  {
    this->Fail("image " + name + " has a matrix that is no rotation");
  }
  const Eigen::Quaterniond q = Eigen::Quaterniond(rotation).normalized();
  image.rotation = { q.w(), q.x(), q.y(), q.z() };
  image.translation = -(q * center);
  this->FailOn(FaultOf(image));
  if (!this->Names.insert(name).second)
  {
    this->Fail("two images are called " + name);
  }
  this->Model.images.push_back(std::move(image));
  return this->Model.images.back().id;
}

void ModelBuilder::AddPoint(
  const Eigen::Vector3d& position, const std::array<std::uint8_t, 3>& color)
{
  SparsePoint& point = this->Model.points.emplace_back();
  point.id = this->Model.points.size();
  point.position = position;
  point.color = color;
  this->FailOn(FaultOf(point));
}

void ModelBuilder::AddObservation(std::uint32_t image, const Eigen::Vector2d& pixel)
{
  SparsePoint& point = this->Model.points.back();
  SparseImage& seeing = this->Model.images[image - 1];
  point.track.push_back({ image, static_cast<std::uint32_t>(seeing.observations.size()) });
  seeing.observations.push_back({ pixel, point.id });
}

}
