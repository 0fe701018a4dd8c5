// SPDX-License-Identifier: BSD-3-Clause
#include "ModelFiles/AliceVisionModel.h"

#include "SparseModel/ModelBuilder.h"
#include "Text/JsonNode.h"

#include <algorithm>
#include <filesystem>
#include <unordered_map>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

using Version = std::array<int, 3>;
using Ids = std::unordered_map<std::uint64_t, std::uint32_t>;

Version VersionOf(const JsonNode& root)
{
  const std::vector<double> numbers = root.At("version").Numbers(3);
  Version version;
  std::transform(numbers.begin(), numbers.end(), version.begin(),
    [](double number) { return static_cast<int>(std::clamp(number, 0.0, 1e6)); });
  return version;
}

double NumberOr(const JsonNode& node, const char* key, double otherwise)
{
  return node.Has(key) ? node.At(key).NumberOrText() : otherwise;
}

// fx and fy, pixels.
std::array<double, 2> FocalLengths(const JsonNode& node, const Version& version, double width)
{
  if (version < Version{ 1, 2, 0 })
  {
    const double f = node.At("pxFocalLength").NumberOrText();
    return { f, f };
  }
  if (version < Version{ 1, 2, 2 })
  {
    const std::vector<double> f = node.At("pxFocalLength").Numbers(2);
    return { f[0], f[1] };
  }
  const double fx =
    node.At("focalLength").NumberOrText() / NumberOr(node, "sensorWidth", 36) * width;
  const double ratio = NumberOr(node, "pixelRatio", 1); // until 1.2.4 that of the focal lengths
  return { fx, version < Version{ 1, 2, 5 } ? fx / ratio : fx * ratio };
}

// Since 1.2.7 the distortion has a name of its own.
std::string KindOf(const JsonNode& node)
{
  const std::string type = node.At("type").Text();
  std::string distortion =
    type == "pinhole" && node.Has("distortionType") ? node.At("distortionType").Text() : type;
  const std::pair<const char*, const char*> same[] = { { "none", "pinhole" },
    { "radialk1", "radial1" }, { "radialk3", "radial3" }, { "fisheye", "fisheye4" } };
  for (const auto& [name, kind] : same)
  {
    if (distortion == name)
    {
      return kind;
    }
  }
  return distortion;
}

SparseCamera CameraOf(const JsonNode& node, const Version& version)
{
  const double width = node.At("width").NumberOrText(), height = node.At("height").NumberOrText();
  const auto [fx, fy] = FocalLengths(node, version, width);
  std::vector<double> c = node.At("principalPoint").Numbers(2);
  if (!(version < Version{ 1, 2, 1 }))
  {
    c[0] += width / 2;
    c[1] += height / 2;
  }
  const std::string kind = KindOf(node);
  const auto parameters = [&](std::size_t count)
  { return node.At("distortionParams").Numbers(count); };
  SparseCamera camera;
  if (kind == "pinhole")
  {
    camera = PerspectiveCamera(fx, fy, c[0], c[1], {});
  }
  else if (kind == "radial1")
  {
    camera = PerspectiveCamera(fx, fy, c[0], c[1], parameters(1));
  }
  else if (kind == "radial3")
  {
    const std::vector<double> k = parameters(3);
    camera = PerspectiveCamera(fx, fy, c[0], c[1], { k[0], k[1], 0, 0, k[2] });
  }
  else if (kind == "brown")
  {
    const std::vector<double> k = parameters(5);
    camera = PerspectiveCamera(fx, fy, c[0], c[1], { k[0], k[1], k[3], k[4], k[2] });
  }
  else if (kind == "fisheye4" || kind == "fisheye1")
  {
    camera.model = kind == "fisheye4" ? LensModel::OpenCVFisheye : LensModel::FieldOfView;
    camera.parameters = { fx, fy, c[0], c[1] };
    const std::vector<double> k = parameters(kind == "fisheye4" ? 4 : 1);
    camera.parameters.insert(camera.parameters.end(), k.begin(), k.end());
  }
  else
  {
    node.At("type").Fail(UnsupportedLens(kind));
  }
  camera.width = node.At("width").Id();
  camera.height = node.At("height").Id();
  return camera;
}

// The folder of all paths, with what they have below it for names.
fs::path CommonFolder(const std::vector<fs::path>& paths)
{
  fs::path common = paths.empty() ? fs::path() : paths.front().parent_path();
  for (const fs::path& path : paths)
  {
    const fs::path folder = path.parent_path();
    fs::path both;
    for (auto a = common.begin(), b = folder.begin();
         a != common.end() && b != folder.end() && *a == *b; ++a, ++b)
    {
      both /= *a;
    }
    common = both;
  }
  return common;
}

void ReadAliceVisionPoints(const JsonNode& root, const Ids& images, ModelBuilder& model)
{
  for (const JsonNode& landmark : root.At("structure").Elements())
  {
    const std::vector<double> x = landmark.At("X").Numbers(3);
    std::array<std::uint8_t, 3> color = {};
    if (landmark.Has("color"))
    {
      const std::vector<double> given = landmark.At("color").Numbers(3);
      for (std::size_t k = 0; k < color.size(); ++k)
      {
        color[k] = static_cast<std::uint8_t>(std::clamp(given[k], 0.0, 255.0));
      }
    }
    model.AddPoint({ x[0], x[1], x[2] }, color);
    if (!landmark.Has("observations"))
    {
      continue;
    }
    for (const JsonNode& observation : landmark.At("observations").Elements())
    {
      const auto image = images.find(observation.At("observationId").Id());
      if (image != images.end() && observation.Has("x"))
      {
        const std::vector<double> pixel = observation.At("x").Numbers(2);
        model.AddObservation(image->second, { pixel[0], pixel[1] });
      }
    }
  }
}

CenteredPose PoseOf(const JsonNode& node)
{
  const std::vector<double> r = node.At("rotation").Numbers(9); // column by column
  const std::vector<double> c = node.At("center").Numbers(3);
  return { Eigen::Map<const Eigen::Matrix3d>(r.data()), Eigen::Vector3d(c[0], c[1], c[2]) };
}

using Poses = std::unordered_map<std::uint64_t, CenteredPose>;

// Of single cameras, or of rigs in the world.
Poses ReadPoses(const JsonNode& root)
{
  Poses poses;
  for (const JsonNode& pose : root.At("poses").Elements())
  {
    poses[pose.At("poseId").Id()] = PoseOf(pose.At("pose").At("transform"));
  }
  return poses;
}

// The cameras of a rig, in its coordinates, by their number there; those that were not found are missing.
std::unordered_map<std::uint64_t, Poses> ReadRigs(const JsonNode& root)
{
  std::unordered_map<std::uint64_t, Poses> rigs;
  if (!root.Has("rigs"))
  {
    return rigs;
  }
  for (const JsonNode& rig : root.At("rigs").Elements())
  {
    Poses& cameras = rigs[rig.At("rigId").Id()];
    std::uint64_t number = 0;
    for (const JsonNode& camera : rig.At("subPoses").Elements())
    {
      if (camera.At("status").Text() != "uninitialized")
      {
        cameras[number] = PoseOf(camera.At("pose"));
      }
      ++number;
    }
  }
  return rigs;
}

// Of a camera whose pose in the coordinates of its rig is given.
CenteredPose PoseInWorld(const CenteredPose& rig, const CenteredPose& camera)
{
  return { camera.rotation * rig.rotation, rig.center + rig.rotation.transpose() * camera.center };
}

struct PlacedView
{
  JsonNode node;
  CenteredPose pose;
  std::uint32_t camera;
};

// Whether the pose of a view is that of its rig: the name in the file is spelt like that.
bool IsOnRig(const JsonNode& view)
{
  return view.Has("isPoseIndependant") && !view.At("isPoseIndependant").Truth();
}

std::vector<PlacedView> PlacedViews(const JsonNode& root, const Ids& cameras)
{
  const Poses poses = ReadPoses(root);
  const std::unordered_map<std::uint64_t, Poses> rigs = ReadRigs(root);
  std::vector<PlacedView> placed;
  for (const JsonNode& view : root.At("views").Elements())
  {
    const auto pose = poses.find(view.At("poseId").Id());
    const auto camera = cameras.find(view.At("intrinsicId").Id());
    if (pose == poses.end() || camera == cameras.end())
    {
      continue;
    }
    if (!IsOnRig(view))
    {
      placed.push_back({ view, pose->second, camera->second });
      continue;
    }
    const auto rig = rigs.find(view.At("rigId").Id());
    if (rig == rigs.end())
    {
      view.At("rigId").Fail("there is no such rig");
    }
    const auto onRig = rig->second.find(view.At("subPoseId").Id());
    if (onRig != rig->second.end())
    {
      placed.push_back({ view, PoseInWorld(pose->second, onRig->second), camera->second });
    }
  }
  return placed;
}

}

SparseModel ReadAliceVisionModel(const std::string& file)
{
  const JsonDocument document(file);
  const JsonNode root = document.Root();
  const Version version = VersionOf(root);
  std::vector<fs::path> paths;
  for (const JsonNode& view : root.At("views").Elements())
  {
    paths.emplace_back(view.At("path").Text());
  }
  const fs::path common = CommonFolder(paths);
  ModelBuilder model(file, (fs::path(file).parent_path() / common).string());
  Ids cameras, images;
  for (const JsonNode& intrinsic : root.At("intrinsics").Elements())
  {
    cameras[intrinsic.At("intrinsicId").Id()] = model.AddCamera(CameraOf(intrinsic, version));
  }
  for (const PlacedView& view : PlacedViews(root, cameras))
  {
    const fs::path path(view.node.At("path").Text());
    const std::string name =
      common.empty() ? path.string() : path.lexically_relative(common).string();
    images[view.node.At("viewId").Id()] =
      model.AddImage(name, view.camera, view.pose.rotation, view.pose.center);
  }
  if (root.Has("structure"))
  {
    ReadAliceVisionPoints(root, images, model);
  }
  return model.Take();
}

}
