// SPDX-License-Identifier: BSD-3-Clause
#include "Calibration/BoardCalibration.h"

#include "Calibration/CameraCalibration.h"
#include "SparseModel/ModelBuilder.h"

#include <filesystem>
#include <map>

namespace freespace
{

namespace fs = std::filesystem;

namespace
{

SparseCamera LensOf(const CalibratedImage& image, std::uint32_t id)
{
  const Eigen::Matrix3d& K = image.camera.K;
  SparseCamera camera = PerspectiveCamera(K(0, 0), K(1, 1), K(0, 2), K(1, 2), image.distortion);
  camera.id = id;
  camera.width = static_cast<std::uint64_t>(image.camera.width);
  camera.height = static_cast<std::uint64_t>(image.camera.height);
  return camera;
}

SparseImage PoseOf(const Camera& camera)
{
  SparseImage image;
  const Eigen::Quaterniond q(camera.R);
  image.rotation = { q.w(), q.x(), q.y(), q.z() };
  image.translation = camera.t;
  return image;
}

}

SparseModel BoardCalibration::Model(const Board& board, const std::string& folder) const
{
  SparseModel model;
  std::vector<SparsePoint> points(BoardPoints(board).size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i].id = i + 1;
    points[i].position = BoardPoints(board)[i];
  }
  std::map<int, std::uint32_t> cameras;
  for (const BoardImage& image : this->images)
  {
    if (!image.used)
    {
      continue;
    }
    const auto next = static_cast<std::uint32_t>(cameras.size() + 1);
    const auto [camera, isNew] = cameras.emplace(image.cameraIndex, next);
    if (isNew)
    {
      model.cameras.push_back(LensOf(image.calibrated, next));
    }
    SparseImage posed = PoseOf(image.calibrated.camera);
    posed.id = static_cast<std::uint32_t>(model.images.size() + 1);
    posed.camera = camera->second;
    posed.name = fs::proximate(fs::absolute(image.file), fs::absolute(folder)).string();
    for (std::size_t k = 0; k < image.corners.ids.size(); ++k)
    {
      SparsePoint& point = points[static_cast<std::size_t>(image.corners.ids[k])];
      point.track.push_back({ posed.id, static_cast<std::uint32_t>(k) });
      posed.observations.push_back({ image.corners.pixels[k], point.id });
    }
    model.images.push_back(std::move(posed));
  }
  for (SparsePoint& point : points)
  {
    if (!point.track.empty())
    {
      model.points.push_back(std::move(point));
    }
  }
  return model;
}

}
