// SPDX-License-Identifier: BSD-3-Clause
#include "Files/PathChecks.h"
#include "ModelFiles/BundlerModel.h"

#include "Common/Error.h"
#include "ModelFiles/UnsizedModel.h"
#include "Text/TextSource.h"

#include <filesystem>
#include <string_view>

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

// The names of the images, and where they are relative to.
struct ImageList
{
  fs::path file;
  std::vector<std::string> names;
};

// A line: a name, which may have blanks; a 0 and a focal length may follow.
std::string NameIn(std::string_view line)
{
  constexpr std::string_view blanks = " \t";
  const std::size_t last = line.find_last_of(blanks);
  const std::size_t end =
    last == std::string_view::npos ? last : line.find_last_not_of(blanks, last);
  const std::size_t zero = end == std::string_view::npos ? end : line.find_last_of(blanks, end);
  if (zero != std::string_view::npos && line.substr(zero + 1, end - zero) == "0" &&
    ParseNumber<double>(line.substr(last + 1)))
  {
    return std::string(line.substr(0, line.find_last_not_of(blanks, zero) + 1));
  }
  return std::string(line);
}

// For NAME.out and NAME.bundle.out: NAME.out.list.txt, NAME.bundle.list.txt or NAME.list.txt beside it, as
// COLMAP and VisualSFM write them, else Bundler's list.txt beside it or above.
ImageList ReadList(const fs::path& file)
{
  const fs::path folder = file.parent_path();
  const fs::path stem = file.stem();
  for (const fs::path& candidate : { folder / (file.filename().string() + ".list.txt"),
         folder / (stem.string() + ".list.txt"), folder / (stem.stem().string() + ".list.txt"),
         folder / "list.txt", folder / ".." / "list.txt" })
  {
    if (IsFile(candidate))
    {
      ImageList list;
      list.file = candidate;
      TextSource source(candidate.string());
      while (source.NextEntry())
      {
        list.names.push_back(NameIn(source.Remainder("the name of an image")));
      }
      return list;
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

}

SparseModel ReadBundlerModel(const std::string& file)
{
  TextSource source(file, TextSource::Lines::Blank);
  const auto cameraCount = source.Number<std::uint64_t>("the number of cameras");
  const auto pointCount = source.Number<std::uint64_t>("the number of points");
  const std::vector<BundlerCamera> cameras = ReadCameras(source, cameraCount);
  const ImageList list = ReadList(file);
  if (!list.file.empty() && list.names.size() < cameras.size())
  {
    throw Error("Cannot read " + list.file.string() + ": it names " +
      std::to_string(list.names.size()) + " images, and " + file + " has " +
      std::to_string(cameras.size()) + ".");
  }
  UnsizedModel::Pixels pixels;
  pixels.up = true;
  pixels.firstCenter = 0;
  UnsizedModel model(pixels);
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    SparseImage image;
    if (cameras[i].focal != 0)
    {
      image.name = list.file.empty() ? "image" + std::to_string(i) : list.names[i];
      SetPose(cameras[i], image);
    }
    const UnsizedModel::Lens lens{ LensModel::Radial,
      { cameras[i].focal, 0, 0, cameras[i].k1, cameras[i].k2 } };
    model.Add(std::move(image), lens, lens);
  }
  model.ReadPoints(source, pointCount);
  return model.Take(file, list.file.parent_path().string());
}

}
