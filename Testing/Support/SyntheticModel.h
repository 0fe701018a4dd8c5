// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SyntheticModel_h
#define freespace_SyntheticModel_h

#include "SparseModel/SparseModel.h"

#include <cmath>
#include <random>

namespace freespace
{

/// Where a lens with radial distortion k1, k2 shows a point, from the definition.
inline Eigen::Vector2d ShowPoint(const CalibratedImage& image, const Eigen::Vector3d& point)
{
  const Eigen::Vector2d normalized = image.camera.FromWorld(point).hnormalized();
  const double r2 = normalized.squaredNorm();
  const double k1 = image.distortion.empty() ? 0 : image.distortion[0];
  const double k2 = image.distortion.empty() ? 0 : image.distortion[1];
  const Eigen::Vector2d distorted = normalized * (1 + k1 * r2 + k2 * r2 * r2);
  return (image.camera.K * distorted.homogeneous()).hnormalized();
}

/// Cameras on an arc of 60 degrees about points in a cube of side 1, each of which is seen by the
/// first image and by others as chance will have it. The observations are exact; some belong to no
/// point.
inline SparseModel MakeSyntheticModel(int images, int points, LensModel lens = LensModel::Pinhole)
{
  std::mt19937 random(17);
  std::uniform_real_distribution<double> coordinate(-0.5, 0.5), chance(0, 1);
  SparseModel model;
  switch (lens)
  {
    case LensModel::SimplePinhole:
      model.cameras.push_back({ 3, lens, 800, 600, { 700, 400, 300 } });
      break;
    case LensModel::Radial:
      model.cameras.push_back({ 3, lens, 800, 600, { 700, 400, 300, -0.1, 0.02 } });
      break;
    default:
      model.cameras.push_back({ 3, LensModel::Pinhole, 800, 600, { 700, 710, 405.5, 290.25 } });
  }
  for (int i = 0; i < points; ++i)
  {
    SparsePoint& point = model.points.emplace_back();
    point.id = static_cast<std::uint64_t>(10 + 2 * i);
    point.position = { coordinate(random), coordinate(random), coordinate(random) };
    point.color = { static_cast<std::uint8_t>(i % 256), 7, 255 };
    point.error = 0.125 * (i % 5);
  }
  for (int i = 0; i < images; ++i)
  {
    SparseImage& image = model.images.emplace_back();
    image.id = static_cast<std::uint32_t>(100 - i);
    image.name = "image" + std::to_string(i) + ".jpg";
    image.camera = 3;
    const double angle = images > 1 ? i * 1.0 / (images - 1) : 0;
    const Eigen::Quaterniond q(Eigen::AngleAxisd(angle, Eigen::Vector3d(0.1, 1, 0).normalized()));
    image.rotation = { q.w(), q.x(), q.y(), q.z() };
    image.translation = { 0.01 * i, 0, 2 };
  }
  const std::vector<CalibratedImage> calibrated = CalibratedImages(model);
  for (int i = 0; i < images; ++i)
  {
    SparseImage& image = model.images[i];
    for (SparsePoint& point : model.points)
    {
      const double luck = chance(random);
      if (luck < 0.1)
      {
        image.observations.push_back({ { 800 * chance(random), 600 * chance(random) } });
      }
      if (luck < 0.8 || i == 0)
      {
        point.track.push_back({ image.id, static_cast<std::uint32_t>(image.observations.size()) });
        image.observations.push_back({ ShowPoint(calibrated[i], point.position), point.id });
      }
    }
  }
  return model;
}

}

#endif
