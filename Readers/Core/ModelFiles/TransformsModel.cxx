// SPDX-License-Identifier: BSD-3-Clause
#include "ModelFiles/TransformsModel.h"

#include "Images/ImageSize.h"
#include "SparseModel/ModelBuilder.h"
#include "Text/JsonNode.h"

#include <cmath>
#include <filesystem>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

// What a frame says, or else the file for all of them.
class Frame
{
public:
  Frame(const JsonNode& frame, const JsonNode& file)
    : Own(frame)
    , Common(file)
  {
  }

  bool Has(const std::string& key) const { return this->Own.Has(key) || this->Common.Has(key); }

  JsonNode At(const std::string& key) const
  {
    return this->Own.Has(key) ? this->Own.At(key) : this->Common.At(key);
  }

  double Number(const std::string& key, double otherwise) const
  {
    return this->Has(key) ? this->At(key).Number() : otherwise;
  }

private:
  JsonNode Own;
  JsonNode Common;
};

// Relative to the file where it stands.
std::string NameOf(const JsonNode& frame)
{
  const fs::path path(frame.At("file_path").Text());
  return (path.has_extension() ? path : fs::path(path.string() + ".png"))
    .lexically_normal()
    .string();
}

double FocalLength(const Frame& frame, const char* length, const char* angle, double size)
{
  if (!frame.Has(length) && frame.Has(angle))
  {
    return size / 2 / std::tan(frame.At(angle).Number() / 2);
  }
  return frame.At(length).Number();
}

SparseCamera LensOf(const Frame& frame, double fx, double fy, double cx, double cy)
{
  const auto k = [&](const char* key) { return frame.Number(key, 0); };
  const std::string model = frame.Has("camera_model") ? frame.At("camera_model").Text() : "OPENCV";
  const bool isFisheye = frame.Has("is_fisheye") && frame.At("is_fisheye").Truth();
  if (model == "OPENCV_FISHEYE" || isFisheye)
  {
    SparseCamera camera;
    camera.model = LensModel::OpenCVFisheye;
    camera.parameters = { fx, fy, cx, cy, k("k1"), k("k2"), k("k3"), k("k4") };
    return camera;
  }
  if (model == "PINHOLE" || model == "SIMPLE_PINHOLE")
  {
    return PerspectiveCamera(fx, fy, cx, cy, {});
  }
  if (model != "OPENCV" && model != "SIMPLE_RADIAL" && model != "RADIAL" && model != "PERSPECTIVE")
  {
    frame.At("camera_model").Fail(UnsupportedLens(model));
  }
  if (k("k4") != 0)
  {
    frame.At("k4").Fail("a perspective lens with a fourth radial coefficient is not supported");
  }
  return PerspectiveCamera(fx, fy, cx, cy, { k("k1"), k("k2"), k("p1"), k("p2"), k("k3") });
}

SparseCamera CameraOf(const Frame& frame, const fs::path& photograph)
{
  double width = 0, height = 0;
  if (frame.Has("w") && frame.Has("h"))
  {
    width = frame.At("w").Number();
    height = frame.At("h").Number();
  }
  else if (const auto size = ReadImageSize(photograph.string()))
  {
    width = (*size)[0];
    height = (*size)[1];
  }
  else
  {
    frame.At("w"); // an error
    frame.At("h");
  }
  if (!(width >= 1 && height >= 1 && width <= 1e9 && height <= 1e9))
  {
    frame.At("w").Fail("the width and height are not usable");
  }
  const double fx = FocalLength(frame, "fl_x", "camera_angle_x", width);
  const double fy = frame.Has("fl_y") || frame.Has("camera_angle_y")
    ? FocalLength(frame, "fl_y", "camera_angle_y", height)
    : fx;
  SparseCamera camera =
    LensOf(frame, fx, fy, frame.Number("cx", width / 2), frame.Number("cy", height / 2));
  camera.width = static_cast<std::uint64_t>(width);
  camera.height = static_cast<std::uint64_t>(height);
  return camera;
}

// A pose with or without its last row.
Eigen::Matrix<double, 3, 4> PoseOf(const JsonNode& matrix)
{
  const std::vector<double> m = matrix.Numbers(matrix.Elements().size() == 3 ? 12 : 16);
  return Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(m.data());
}

// What nerfstudio has done to the world of the model that it converted.
struct WorldChange
{
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

WorldChange WorldChangeOf(const JsonNode& file)
{
  WorldChange change;
  const char* key = "applied_transform";
  if (!file.Has(key))
  {
    return change;
  }
  const JsonNode matrix = file.At(key);
  const Eigen::Matrix<double, 3, 4> rows = PoseOf(matrix);
  change.rotation = rows.leftCols<3>();
  change.translation = rows.col(3);
  constexpr double rounding = 1e-6;
  if (!(change.rotation.isUnitary(rounding) && change.rotation.determinant() > 0 &&
        change.translation.allFinite()))
  {
    matrix.Fail("it is no rotation with a translation");
  }
  return change;
}

}

SparseModel ReadTransformsModel(const std::string& file)
{
  const JsonDocument document(file);
  const JsonNode root = document.Root();
  const fs::path folder = fs::path(file).parent_path();
  const WorldChange change = WorldChangeOf(root);
  ModelBuilder model(file, folder.string());
  for (const JsonNode& element : root.At("frames").Elements())
  {
    const Frame frame(element, root);
    const std::string name = NameOf(element);
    const std::uint32_t camera = model.AddCamera(CameraOf(frame, folder / name));
    const Eigen::Matrix<double, 3, 4> worldFromCamera = PoseOf(element.At("transform_matrix"));
    const Eigen::Vector3d turn(1, -1, -1); // from y up, looking along -z
    model.AddImage(name, camera,
      turn.asDiagonal() * worldFromCamera.leftCols<3>().transpose() * change.rotation,
      change.rotation.transpose() * (worldFromCamera.col(3) - change.translation));
  }
  return model.Take();
}

}
