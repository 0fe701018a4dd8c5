// SPDX-License-Identifier: BSD-3-Clause
#include "ModelFiles/OpenMvgModel.h"

#include "SparseModel/ModelBuilder.h"
#include "Text/JsonNode.h"

#include <filesystem>
#include <unordered_map>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

// What a shared pointer of the cereal library points to; base classes may stand in value0.
JsonNode DataOf(const JsonNode& value)
{
  return value.At("ptr_wrapper").At("data");
}

JsonNode Member(const JsonNode& data, const std::string& key)
{
  return !data.Has(key) && data.Has("value0") ? Member(data.At("value0"), key) : data.At(key);
}

// The name of a class is told with its first object only, later ones refer to it.
class ClassNames
{
public:
  std::string Of(const JsonNode& value)
  {
    constexpr std::uint64_t isFirst = 0x80000000u;
    const std::uint64_t id = value.At("polymorphic_id").Id() & ~isFirst;
    if (value.Has("polymorphic_name"))
    {
      this->Names[id] = value.At("polymorphic_name").Text();
    }
    const auto name = this->Names.find(id);
    if (name == this->Names.end())
    {
      value.At("polymorphic_id").Fail("its class has no name in the file");
    }
    return name->second;
  }

private:
  std::unordered_map<std::uint64_t, std::string> Names;
};

SparseCamera CameraOf(const JsonNode& data, const std::string& kind)
{
  const double f = Member(data, "focal_length").Number();
  const std::vector<double> c = Member(data, "principal_point").Numbers(2);
  SparseCamera camera;
  if (kind == "pinhole")
  {
    camera = PerspectiveCamera(f, f, c[0], c[1], {});
  }
  else if (kind == "pinhole_radial_k1")
  {
    camera = PerspectiveCamera(f, f, c[0], c[1], Member(data, "disto_k1").Numbers(1));
  }
  else if (kind == "pinhole_radial_k3")
  {
    const std::vector<double> k = Member(data, "disto_k3").Numbers(3);
    camera = PerspectiveCamera(f, f, c[0], c[1], { k[0], k[1], 0, 0, k[2] });
  }
  else if (kind == "pinhole_brown_t2")
  {
    const std::vector<double> k = Member(data, "disto_t2").Numbers(5);
    camera = PerspectiveCamera(f, f, c[0], c[1], { k[0], k[1], k[3], k[4], k[2] });
  }
  else if (kind == "fisheye")
  {
    const std::vector<double> k = Member(data, "fisheye").Numbers(4);
    camera.model = LensModel::OpenCVFisheye;
    camera.parameters = { f, f, c[0], c[1], k[0], k[1], k[2], k[3] };
  }
  else
  {
    data.Fail(UnsupportedLens(kind));
  }
  camera.width = Member(data, "width").Id();
  camera.height = Member(data, "height").Id();
  return camera;
}

std::unordered_map<std::uint64_t, std::uint32_t> ReadIntrinsics(
  const JsonNode& root, ModelBuilder& model)
{
  ClassNames names;
  std::unordered_map<std::uint64_t, std::uint32_t> cameras;
  for (const JsonNode& element : root.At("intrinsics").Elements())
  {
    const JsonNode value = element.At("value");
    const std::string kind = names.Of(value);
    cameras[element.At("key").Id()] = model.AddCamera(CameraOf(DataOf(value), kind));
  }
  return cameras;
}

std::unordered_map<std::uint64_t, CenteredPose> ReadOpenMvgPoses(const JsonNode& root)
{
  std::unordered_map<std::uint64_t, CenteredPose> poses;
  for (const JsonNode& element : root.At("extrinsics").Elements())
  {
    const std::vector<double> r = element.At("value").At("rotation").Numbers(9);
    const std::vector<double> c = element.At("value").At("center").Numbers(3);
    poses[element.At("key").Id()] = {
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(r.data()),
      Eigen::Vector3d(c[0], c[1], c[2])
    };
  }
  return poses;
}

void ReadOpenMvgPoints(const JsonNode& root,
  const std::unordered_map<std::uint64_t, std::uint32_t>& images, ModelBuilder& model)
{
  for (const JsonNode& element : root.At("structure").Elements())
  {
    const JsonNode value = element.At("value");
    const std::vector<double> x = value.At("X").Numbers(3);
    model.AddPoint({ x[0], x[1], x[2] }, {});
    for (const JsonNode& observation : value.At("observations").Elements())
    {
      const auto image = images.find(observation.At("key").Id());
      const std::vector<double> pixel = observation.At("value").At("x").Numbers(2);
      if (image != images.end())
      {
        model.AddObservation(image->second, { pixel[0], pixel[1] });
      }
    }
  }
}

}

SparseModel ReadOpenMvgModel(const std::string& file)
{
  const JsonDocument document(file);
  const JsonNode root = document.Root();
  const std::string given =
    root.Has("root_path") && root.At("root_path").IsFilled() ? root.At("root_path").Text() : "";
  const fs::path folder =
    fs::path(file).parent_path() / given; // or the given one when it is absolute
  ModelBuilder model(file, folder.string());
  const auto cameras = ReadIntrinsics(root, model);
  const auto poses = ReadOpenMvgPoses(root);
  std::unordered_map<std::uint64_t, std::uint32_t> images;
  for (const JsonNode& element : root.At("views").Elements())
  {
    const JsonNode data = DataOf(element.At("value"));
    const auto pose = poses.find(Member(data, "id_pose").Id());
    const auto camera = cameras.find(Member(data, "id_intrinsic").Id());
    if (pose == poses.end() || camera == cameras.end())
    {
      continue;
    }
    const JsonNode local = Member(data, "local_path");
    const fs::path name =
      fs::path(local.IsFilled() ? local.Text() : "") / Member(data, "filename").Text();
    images[element.At("key").Id()] = model.AddImage(
      name.relative_path().string(), camera->second, pose->second.rotation, pose->second.center);
  }
  if (root.Has("structure"))
  {
    ReadOpenMvgPoints(root, images, model);
  }
  return model.Take();
}

}
