// SPDX-License-Identifier: BSD-3-Clause
#include "ModelFiles/MetashapeModel.h"

#include "Common/ParseNumber.h"
#include "SparseModel/ModelBuilder.h"
#include "Text/XmlNode.h"

#include <filesystem>
#include <map>
#include <set>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

// The adjusted one, or else the last.
const XmlNode& CalibrationOf(const XmlNode& sensor)
{
  const XmlNode* best = nullptr;
  for (const XmlNode& node : sensor.children)
  {
    if (node.name == "calibration" && (!best || best->Attribute("class") != "adjusted"))
    {
      best = &node;
    }
  }
  if (!best)
  {
    sensor.Fail("the sensor '" + sensor.Attribute("label") + "' has no calibration");
  }
  return *best;
}

std::uint64_t SizeOf(const XmlNode& resolution, const char* key)
{
  const auto size = ParseNumber<std::uint64_t>(resolution.Attribute(key));
  if (!size)
  {
    resolution.Fail("the resolution has no usable " + std::string(key));
  }
  return *size;
}

SparseCamera CameraOf(const XmlNode& sensor)
{
  const std::string type = sensor.Attribute("type");
  const XmlNode& calibration = CalibrationOf(sensor);
  const XmlNode& resolution = sensor.At("resolution");
  const std::uint64_t width = SizeOf(resolution, "width"), height = SizeOf(resolution, "height");
  const auto value = [&](const char* name) { return calibration.NumberOr(name, 0); };
  if (type != "frame" && type != "fisheye")
  {
    sensor.Fail(UnsupportedLens(type));
  }
  if (value("b2") != 0 || (type == "frame" && value("k4") != 0))
  {
    calibration.Fail(
      "the coefficients b2 and k4 are not supported: align the cameras without them");
  }
  double fx = value("fx"), fy = value("fy"), cx = value("cx"), cy = value("cy");
  if (calibration.Find("f")) // fx and fy with an absolute cx and cy are of older versions
  {
    fx = value("f") + value("b1");
    fy = value("f");
    cx += static_cast<double>(width) / 2;
    cy += static_cast<double>(height) / 2;
  }
  SparseCamera camera; // OpenCV's p1 is their p2
  if (type == "frame")
  {
    camera = PerspectiveCamera(
      fx, fy, cx, cy, { value("k1"), value("k2"), value("p2"), value("p1"), value("k3") });
  }
  else
  {
    camera.model = LensModel::ThinPrismFisheye;
    camera.parameters = { fx, fy, cx, cy, value("k1"), value("k2"), value("p2"), value("p1"),
      value("k3"), value("k4"), 0, 0 };
  }
  camera.width = width;
  camera.height = height;
  return camera;
}

// Images by their names without extension, relative to the folder.
std::map<std::string, std::string> PhotographsBelow(const fs::path& folder)
{
  std::map<std::string, std::string> photographs;
  for (const fs::path& below : { folder / "images", folder })
  {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(below.empty() ? "." : below, error))
    {
      const std::string ending = entry.path().extension().string();
      for (const char* known : { ".jpg", ".JPG", ".jpeg", ".png", ".PNG", ".tif", ".tiff", ".TIF" })
      {
        if (ending == known)
        {
          photographs[entry.path().stem().string()] =
            (below == folder ? fs::path() : fs::path("images")) / entry.path().filename();
        }
      }
    }
  }
  return photographs;
}

// Groups that were not aligned with each other have coordinates of their own.
void CheckComponents(const XmlNode& cameras)
{
  std::set<std::string> components;
  for (const XmlNode& camera : cameras.children)
  {
    if (camera.Find("transform"))
    {
      components.insert(camera.Attribute("component_id"));
    }
  }
  if (components.size() > 1)
  {
    cameras.Fail("its cameras are in " + std::to_string(components.size()) +
      " components that are not aligned with each other: export one of them");
  }
}

}

SparseModel ReadMetashapeModel(const std::string& file)
{
  const XmlNode document = ReadXmlFile(file);
  if (document.name != "document")
  {
    document.Fail("it is not a Metashape file of cameras, whose first element is 'document'");
  }
  const XmlNode& chunk = document.At("chunk");
  const fs::path folder = fs::path(file).parent_path();
  ModelBuilder model(file, folder.string());
  std::map<std::string, const XmlNode*> sensors;
  for (const XmlNode& sensor : chunk.At("sensors").children)
  {
    sensors[sensor.Attribute("id")] = &sensor;
  }
  const auto photographs = PhotographsBelow(folder);
  const XmlNode& cameras = chunk.At("cameras");
  CheckComponents(cameras);
  for (const XmlNode& camera : cameras.children)
  {
    const std::string enabled = camera.Attribute("enabled");
    if (camera.name != "camera" || !camera.Find("transform") || enabled == "false" ||
      enabled == "0")
    {
      continue;
    }
    const auto sensor = sensors.find(camera.Attribute("sensor_id"));
    if (sensor == sensors.end())
    {
      camera.Fail("the camera '" + camera.Attribute("label") + "' has no known sensor");
    }
    const std::vector<double> m = camera.At("transform").Numbers(16);
    const Eigen::Matrix<double, 3, 4> worldFromCamera =
      Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(m.data());
    const auto photograph = photographs.find(camera.Attribute("label"));
    model.AddImage(photograph == photographs.end() ? camera.Attribute("label") : photograph->second,
      model.AddCamera(CameraOf(*sensor->second)), worldFromCamera.leftCols<3>().transpose(),
      worldFromCamera.col(3));
  }
  return model.Take();
}

}
