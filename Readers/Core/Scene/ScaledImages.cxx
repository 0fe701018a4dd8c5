// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/ScaledImages.h"

#include "Images/ImageSize.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <tuple>

namespace freespace
{

namespace
{

bool IsScaled(const SparseCamera& camera, const std::array<int, 2>& size)
{
  const double width = static_cast<double>(camera.width);
  const double height = static_cast<double>(camera.height);
  if (!(width > 0 && height > 0) || (size[0] == width && size[1] == height))
  {
    return false;
  }
  constexpr double rounding = 1; // pixel
  constexpr double alike = 0.01; // in small images a pixel is much
  const double x = size[0] / width, y = size[1] / height, scale = std::max(x, y);
  return std::abs(scale * width - size[0]) <= rounding &&
    std::abs(scale * height - size[1]) <= rounding && std::abs(x - y) <= alike * scale;
}

}

SparseCamera ScaledCamera(const SparseCamera& camera, int width, int height)
{
  SparseCamera scaled = camera;
  scaled.width = static_cast<std::uint64_t>(width);
  scaled.height = static_cast<std::uint64_t>(height);
  const double x = width / static_cast<double>(camera.width);
  const double y = height / static_cast<double>(camera.height);
  const std::size_t focal = FocalLengths(camera.model);
  if (focal == 1)
  {
    scaled.parameters[0] *= std::sqrt(x * y);
  }
  else
  {
    scaled.parameters[0] *= x;
    scaled.parameters[1] *= y;
  }
  scaled.parameters[focal] *= x;
  scaled.parameters[focal + 1] *= y;
  return scaled;
}

std::string ScaleToPhotographs(const Scene& scene, SparseModel& model)
{
  std::map<std::uint32_t, SparseCamera> cameras;
  std::uint32_t next = 0; // free id
  for (const SparseCamera& camera : model.cameras)
  {
    cameras[camera.id] = camera;
    next = std::max(next, camera.id + 1);
  }
  std::map<std::tuple<std::uint32_t, int, int>, std::uint32_t> scaledIds;
  std::size_t count = 0;
  double least = 0, most = 0;
  for (SparseImage& image : model.images)
  {
    const auto camera = cameras.find(image.camera);
    const auto size = ReadImageSize(scene.ImagePath(image.name));
    if (!size || camera == cameras.end() || !IsScaled(camera->second, *size))
    {
      continue;
    }
    const SparseCamera& given = camera->second;
    const auto [known, isNew] =
      scaledIds.emplace(std::tuple(given.id, (*size)[0], (*size)[1]), next);
    if (isNew)
    {
      model.cameras.push_back(ScaledCamera(given, (*size)[0], (*size)[1]));
      model.cameras.back().id = next++;
    }
    image.camera = known->second;
    const Eigen::Array2d scale((*size)[0] / static_cast<double>(given.width),
      (*size)[1] / static_cast<double>(given.height));
    for (SparseObservation& observation : image.observations)
    {
      observation.pixel = (observation.pixel.array() * scale).matrix();
    }
    least = count == 0 ? scale.x() : std::min(least, scale.x());
    most = std::max(most, scale.x());
    ++count;
  }
  if (count == 0)
  {
    return "";
  }
  char factor[80];
  std::snprintf(
    factor, sizeof(factor), most > 1.001 * least ? "%.4g to %.4g" : "%.4g", least, most);
  return std::to_string(count) + " of " + std::to_string(model.images.size()) +
    " images have another size than their cameras, which are scaled by " + factor;
}

}
