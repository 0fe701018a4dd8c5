// SPDX-License-Identifier: BSD-3-Clause
#include "SparseModel/BundlerModel.h"

#include "Common/Error.h"
#include "SparseModel/CenteredObservations.h"
#include "Text/TextSource.h"

#include <filesystem>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

struct BundlerCamera
{
  double focal = 0; // 0: not placed
  double k1 = 0;
  double k2 = 0;
  Eigen::Matrix3d rotation;
  Eigen::Vector3d translation;
};

std::vector<BundlerCamera> ReadCameras(TextSource& source, std::uint64_t count)
{
  std::vector<BundlerCamera> cameras;
  for (std::uint64_t i = 0; i < count; ++i)
  {
    BundlerCamera& camera = cameras.emplace_back();
    camera.focal = source.Number<double>("a focal length");
    camera.k1 = source.Number<double>("a radial distortion");
    camera.k2 = source.Number<double>("a radial distortion");
    for (int k = 0; k < 9; ++k)
    {
      camera.rotation(k / 3, k % 3) = source.Number<double>("a part of a rotation");
    }
    for (double& t : camera.translation)
    {
      t = source.Number<double>("a part of a translation");
    }
    const double deviation =
      (camera.rotation * camera.rotation.transpose() - Eigen::Matrix3d::Identity()).norm();
    if (camera.focal != 0 && !(deviation < 1e-3))
    {
      source.Fail("camera " + std::to_string(i) + " has a matrix that is no rotation");
    }
  }
  return cameras;
}

// Beside the file or above it; the folder to which its lines are relative goes into `base`.
std::vector<std::string> ReadList(const fs::path& file, fs::path& base)
{
  for (const fs::path& folder : { file.parent_path(), file.parent_path() / ".." })
  {
    if (fs::is_regular_file(folder / "list.txt"))
    {
      base = folder;
      std::vector<std::string> names;
      TextSource source((folder / "list.txt").string());
      while (source.NextEntry())
      {
        names.emplace_back(source.Field("the name of an image")); // a focal length may follow
      }
      return names;
    }
  }
  return {};
}

// From looking along -z with y up to looking along z with y down.
void SetPose(const BundlerCamera& from, SparseImage& to)
{
  const Eigen::Vector3d turn(1, -1, -1);
  const Eigen::Quaterniond q(Eigen::Matrix3d(turn.asDiagonal() * from.rotation));
  to.rotation = { q.w(), q.x(), q.y(), q.z() };
  to.translation = turn.cwiseProduct(from.translation);
}

void ReadPoints(TextSource& source, std::uint64_t count, const std::vector<BundlerCamera>& cameras,
  CenteredObservations& observations)
{
  for (std::uint64_t i = 0; i < count; ++i)
  {
    SparsePoint point;
    point.id = i + 1;
    for (double& x : point.position)
    {
      x = source.Number<double>("a coordinate");
    }
    for (std::uint8_t& channel : point.color)
    {
      channel = source.Number<std::uint8_t>("a colour from 0 to 255");
    }
    const auto views = source.Number<std::uint64_t>("a number of views");
    for (std::uint64_t k = 0; k < views; ++k)
    {
      const auto camera = source.Number<std::uint64_t>("the index of a camera");
      source.Number<std::uint64_t>("the index of a key");
      const double x = source.Number<double>("an observation's x");
      const double y = source.Number<double>("an observation's y");
      if (camera >= cameras.size())
      {
        source.Fail("there is no camera " + std::to_string(camera));
      }
      if (cameras[camera].focal != 0)
      {
        observations.Add(static_cast<std::size_t>(camera), { x, -y }, point);
      }
    }
    if (const std::string fault = FaultOf(point); !fault.empty())
    {
      source.Fail(fault);
    }
    observations.Finish(std::move(point));
  }
}

}

SparseModel ReadBundlerModel(const std::string& file)
{
  TextSource source(file, TextSource::Lines::Blank);
  const auto cameraCount = source.Number<std::uint64_t>("the number of cameras");
  const auto pointCount = source.Number<std::uint64_t>("the number of points");
  const std::vector<BundlerCamera> cameras = ReadCameras(source, cameraCount);
  fs::path base;
  const std::vector<std::string> names = ReadList(file, base);
  if (!names.empty() && names.size() < cameras.size())
  {
    throw Error("Cannot read " + (base / "list.txt").string() + ": it names " +
      std::to_string(names.size()) + " images, and " + file + " has " +
      std::to_string(cameras.size()) + ".");
  }
  CenteredObservations observations(cameras.size());
  ReadPoints(source, pointCount, cameras, observations);
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    if (cameras[i].focal != 0)
    {
      SparseImage image;
      image.name = names.empty() ? "image" + std::to_string(i) : names[i];
      SetPose(cameras[i], image);
      observations.Place(i, std::move(image), LensModel::Radial,
        { cameras[i].focal, 0, 0, cameras[i].k1, cameras[i].k2 }, base.string());
    }
  }
  return observations.Take(file);
}

}
