// SPDX-License-Identifier: BSD-3-Clause
#include "ModelFiles/MiddleburyModel.h"

#include "Images/ImageSize.h"
#include "SparseModel/ModelBuilder.h"
#include "Text/TextSource.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

Eigen::Matrix3d ReadMatrix(TextSource& source, const char* what)
{
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 9; ++i)
  {
    matrix(i / 3, i % 3) = source.Number<double>(what);
  }
  return matrix;
}

SparseCamera CameraOf(const Eigen::Matrix3d& K, const fs::path& photograph)
{
  SparseCamera camera = PerspectiveCamera(K(0, 0), K(1, 1), K(0, 2), K(1, 2), {});
  const auto size = ReadImageSize(photograph.string());
  const auto twice = [](double middle)
  { return static_cast<std::uint64_t>(std::clamp(std::ceil(2 * middle), 0.0, 1e9)); };
  camera.width = size ? static_cast<std::uint64_t>((*size)[0]) : twice(K(0, 2));
  camera.height = size ? static_cast<std::uint64_t>((*size)[1]) : twice(K(1, 2));
  return camera;
}

}

SparseModel ReadMiddleburyModel(const std::string& file)
{
  TextSource source(file, TextSource::Lines::Blank);
  const fs::path folder = fs::path(file).parent_path();
  ModelBuilder model(file, folder.string());
  const auto count = source.Number<std::uint64_t>("the number of images");
  for (std::uint64_t i = 0; i < count; ++i)
  {
    const std::string name(source.Field("the name of an image"));
    const Eigen::Matrix3d K = ReadMatrix(source, "a number of K");
    const Eigen::Matrix3d R = ReadMatrix(source, "a number of R");
    Eigen::Vector3d t;
    for (double& number : t)
    {
      number = source.Number<double>("a number of t");
    }
    const double skew = std::abs(K(0, 1)) + std::abs(K(1, 0)) + std::abs(K(2, 0)) +
      std::abs(K(2, 1)) + std::abs(K(2, 2) - 1);
    if (!(skew <= 1e-9 * std::abs(K(0, 0))))
    {
      source.Fail(
        "the K of " + name + " has skew or is no calibration matrix, which is not supported");
    }
    model.AddImage(name, model.AddCamera(CameraOf(K, folder / name)), R, -R.transpose() * t);
  }
  return model.Take();
}

}
