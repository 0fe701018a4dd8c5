// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ParallelCameras_h
#define freespace_ParallelCameras_h

#include "SparseModel/SparseModel.h"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace freespace
{

/// Cameras of 800 x 800 pixels that look along z, all alike, at places in the plane z = 0: at depth d they see a square
/// of side 800 d / focal. Without points.
inline SparseModel ParallelCameras(const std::vector<Eigen::Vector2d>& places, double focal)
{
  SparseModel model;
  model.cameras.push_back({ 1, LensModel::Pinhole, 800, 800, { focal, focal, 400, 400 } });
  for (const Eigen::Vector2d& place : places)
  {
    SparseImage image;
    image.id = static_cast<std::uint32_t>(model.images.size() + 1);
    image.name = std::to_string(image.id) + ".jpg";
    image.camera = 1;
    image.translation = -Eigen::Vector3d(place.x(), place.y(), 0);
    model.images.push_back(image);
  }
  return model;
}

}

#endif
