// SPDX-License-Identifier: BSD-3-Clause
#include "ModelFiles/NvmModel.h"

#include "ModelFiles/UnsizedModel.h"
#include "Text/TextSource.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>

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

// The calibration of all images: fx cx fy cy.
using FixedCalibration = std::optional<std::array<double, 4>>;

FixedCalibration ReadHeader(TextSource& source)
{
  if (source.Field("NVM_V3") != "NVM_V3")
  {
    source.Fail("it does not begin with NVM_V3");
  }
  if (source.AtLineEnd())
  {
    return std::nullopt;
  }
  if (const std::string_view word = source.Field("FixedK"); word != "FixedK")
  {
    source.Fail("'" + std::string(word.substr(0, 40)) + "' is not FixedK");
  }
  std::array<double, 4> calibration;
  for (double& number : calibration)
  {
    number = source.Number<double>("a number of FixedK fx cx fy cy");
  }
  while (!source.AtLineEnd())
  {
    if (source.Number<double>("a distortion") != 0)
    {
      source.Fail("a distortion in FixedK is not supported; those of the cameras are");
    }
  }
  return calibration;
}

int CountFields(std::string_view line)
{
  int count = 0;
  for (std::size_t i = 0; i < line.size(); ++i)
  {
    const bool isBlank = line[i] == ' ' || line[i] == '\t';
    count += !isBlank && (i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t');
  }
  return count;
}

NvmCamera ReadCamera(TextSource& source)
{
  NvmCamera camera;
  constexpr int numbers = 10; // that follow; in COLMAP's files names may have blanks
  camera.image.name = source.Field("the name of an image");
  while (CountFields(source.Ahead()) > numbers)
  {
    camera.image.name += " " + std::string(source.Field("the name of an image"));
  }
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

// The lens as VisualSFM means it: m(u) of u = m + r m^3 is u - r u^3 + 3 r^2 u^5 - 12 r^3 u^7 + ...
UnsizedModel::Lens LensOf(const NvmCamera& camera, const FixedCalibration& fixed)
{
  const double r = camera.distortion;
  const double fx = fixed ? (*fixed)[0] : camera.focal;
  const double fy = fixed ? (*fixed)[2] : camera.focal;
  if (r != 0)
  {
    return { LensModel::FullOpenCV,
      { fx, fy, 0, 0, -r, 3 * r * r, 0, 0, -12 * r * r * r, 0, 0, 0 } };
  }
  return fx == fy ? UnsizedModel::Lens{ LensModel::SimplePinhole, { fx, 0, 0 } }
                  : UnsizedModel::Lens{ LensModel::Pinhole, { fx, fy, 0, 0 } };
}

UnsizedModel::Lens ColmapLensOf(const NvmCamera& camera)
{
  return camera.distortion == 0
    ? UnsizedModel::Lens{ LensModel::SimplePinhole, { camera.focal, 0, 0 } }
    : UnsizedModel::Lens{ LensModel::SimpleRadial, { camera.focal, 0, 0, -camera.distortion } };
}

}

SparseModel ReadNvmModel(const std::string& file)
{
  TextSource source(file, TextSource::Lines::Blank);
  UnsizedModel::Pixels pixels;
  const FixedCalibration fixed = ReadHeader(source);
  if (fixed)
  {
    pixels.origin = Eigen::Vector2d((*fixed)[1], (*fixed)[3]);
  }
  UnsizedModel model(pixels);
  const auto images = source.Number<std::uint64_t>("the number of images");
  for (std::uint64_t i = 0; i < images; ++i)
  {
    NvmCamera camera = ReadCamera(source);
    model.Add(std::move(camera.image), LensOf(camera, fixed), ColmapLensOf(camera));
  }
  model.ReadPoints(source, source.Number<std::uint64_t>("the number of points"));
  return model.Take(file, std::filesystem::path(file).parent_path().string());
}

}
