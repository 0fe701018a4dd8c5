// SPDX-License-Identifier: BSD-3-Clause
#include "SparseModel/NvmModel.h"

#include "SparseModel/CenteredObservations.h"
#include "Text/TextSource.h"

#include <algorithm>
#include <filesystem>

namespace freespace
{

namespace
{

struct NvmCamera
{
  SparseImage image;
  double focal = 0;
  double distortion = 0;
};

void ReadHeader(TextSource& source)
{
  if (source.Field("NVM_V3") != "NVM_V3")
  {
    source.Fail("it does not begin with NVM_V3");
  }
  if (!source.AtLineEnd())
  {
    source.Fail("a fixed calibration in the first line is not supported");
  }
}

NvmCamera ReadCamera(TextSource& source)
{
  NvmCamera camera;
  camera.image.name = source.Field("the name of an image");
  std::replace(camera.image.name.begin(), camera.image.name.end(), '"', ' '); // VisualSFM's way
  camera.focal = source.Number<double>("a focal length");
  for (double& q : camera.image.rotation)
  {
    q = source.Number<double>("a part of a quaternion");
  }
  Eigen::Vector3d center;
  for (double& c : center)
  {
    c = source.Number<double>("a part of the camera's centre");
  }
  const auto& [w, x, y, z] = camera.image.rotation;
  camera.image.translation = -(Eigen::Quaterniond(w, x, y, z).normalized() * center);
  camera.distortion = source.Number<double>("a radial distortion");
  source.Number<double>("the 0 that ends a camera");
  if (const std::string fault = FaultOf(camera.image); !fault.empty())
  {
    source.Fail(fault);
  }
  return camera;
}

void ReadPoint(
  TextSource& source, std::uint64_t id, std::size_t cameras, CenteredObservations& observations)
{
  SparsePoint point;
  point.id = id;
  for (double& x : point.position)
  {
    x = source.Number<double>("a coordinate");
  }
  for (std::uint8_t& channel : point.color)
  {
    channel = source.Number<std::uint8_t>("a colour from 0 to 255");
  }
  const auto views = source.Number<std::uint64_t>("a number of measurements");
  for (std::uint64_t k = 0; k < views; ++k)
  {
    const auto camera = source.Number<std::uint64_t>("the index of an image");
    source.Number<std::uint64_t>("the index of a feature");
    const double x = source.Number<double>("a measurement's x");
    const double y = source.Number<double>("a measurement's y");
    if (camera >= cameras)
    {
      source.Fail("there is no image " + std::to_string(camera));
    }
    observations.Add(static_cast<std::size_t>(camera), { x, y }, point);
  }
  if (const std::string fault = FaultOf(point); !fault.empty())
  {
    source.Fail(fault);
  }
  observations.Finish(std::move(point));
}

void Place(std::size_t index, NvmCamera camera, const std::string& folder,
  CenteredObservations& observations)
{
  const double f = camera.focal, r = camera.distortion;
  if (r == 0)
  {
    observations.Place(
      index, std::move(camera.image), LensModel::SimplePinhole, { f, 0, 0 }, folder);
    return;
  }
  // m(u) of u = m + r m^3 is u - r u^3 + 3 r^2 u^5 - 12 r^3 u^7 + ...
  observations.Place(index, std::move(camera.image), LensModel::FullOpenCV,
    { f, f, 0, 0, -r, 3 * r * r, 0, 0, -12 * r * r * r, 0, 0, 0 }, folder);
}

}

SparseModel ReadNvmModel(const std::string& file)
{
  TextSource source(file, TextSource::Lines::Blank);
  ReadHeader(source);
  const auto imageCount = source.Number<std::uint64_t>("the number of images");
  std::vector<NvmCamera> cameras;
  for (std::uint64_t i = 0; i < imageCount; ++i)
  {
    cameras.push_back(ReadCamera(source));
  }
  const auto pointCount = source.Number<std::uint64_t>("the number of points");
  CenteredObservations observations(cameras.size());
  for (std::uint64_t i = 0; i < pointCount; ++i)
  {
    ReadPoint(source, i + 1, cameras.size(), observations);
  }
  const std::string folder = std::filesystem::path(file).parent_path().string();
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    Place(i, std::move(cameras[i]), folder, observations);
  }
  return observations.Take(file);
}

}
