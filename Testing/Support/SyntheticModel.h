// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SyntheticModel_h
#define freespace_SyntheticModel_h

#include "SparseModel/SparseModel.h"
#include "Support/LensFormulas.h"

#include <algorithm>
#include <random>

namespace freespace
{

/// Where the image shows a point, by the formula of its lens.
inline Eigen::Vector2d ShowPoint(
  const SparseModel& model, std::size_t image, const Eigen::Vector3d& point)
{
  const SparseImage& seeing = model.images[image];
  const auto camera = std::find_if(model.cameras.begin(), model.cameras.end(),
    [&](const SparseCamera& other) { return other.id == seeing.camera; });
  return ShowByFormula(*camera, CalibratedImageOf(seeing, *camera).camera.FromWorld(point));
}

/// Cameras on an arc of 60 degrees about points in a cube of side 1, each of which is seen by the
/// first image and by others at random. The observations are exact; some belong to no
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
    case LensModel::SimpleRadial:
      model.cameras.push_back({ 3, lens, 800, 600, { 700, 400, 300, -0.1 } });
      break;
    case LensModel::Radial:
      model.cameras.push_back({ 3, lens, 800, 600, { 700, 400, 300, -0.1, 0.02 } });
      break;
    case LensModel::Pinhole:
      model.cameras.push_back({ 3, lens, 800, 600, { 700, 710, 405.5, 290.25 } });
      break;
    default:
      model.cameras.push_back(CameraWithLens(lens));
  }
  for (int i = 0; i < points; ++i)
  {
    SparsePoint& point = model.points.emplace_back();
    point.id = 10 + 2 * static_cast<std::uint64_t>(i);
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
        image.observations.push_back(
          { ShowPoint(model, static_cast<std::size_t>(i), point.position), point.id });
      }
    }
  }
  return model;
}

}

#endif
