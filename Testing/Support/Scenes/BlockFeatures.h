// SPDX-License-Identifier: BSD-3-Clause
#ifndef BlockFeatures_h
#define BlockFeatures_h

#include "Support/Scenes/BlockScene.h"

#include <algorithm>
#include <string>

constexpr int BlockCameras = 6;

/// What a camera sees of the corners of a grid on the board and on the block, its edges included.
inline freespace::View BlockView(const BlockScene& scene, int index)
{
  freespace::View view;
  view.name = "v" + std::to_string(index);
  view.imageFile = "p" + std::to_string(index) + ".png";
  view.camera = scene.CameraAt(2 * M_PI * index / BlockCameras);
  const freespace::DisparityImage depths = RenderDisparity(scene.Mesh(), view.camera);
  const auto add = [&](const Eigen::Vector3d& point)
  {
    const Eigen::Vector2d pixel = view.camera.Project(point);
    const int u = static_cast<int>(pixel.x()), v = static_cast<int>(pixel.y());
    if (u < 1 || v < 1 || u >= view.camera.width - 1 || v >= view.camera.height - 1)
    {
      return;
    }
    float nearest = 0;
    float farthest = 1e9F;
    for (int i = 0; i < 9; ++i)
    {
      const float disparity = depths.At(u + i % 3 - 1, v + i / 3 - 1);
      nearest = std::max(nearest, disparity);
      farthest = std::min(farthest, disparity);
    }
    if (1 / view.camera.Depth(point) > farthest * 0.999 &&
      1 / view.camera.Depth(point) > nearest * 0.985)
    {
      view.points.push_back(point);
      view.imagePoints.push_back(pixel);
    }
  };
  for (int i = -10; i <= 10; ++i)
  {
    for (int j = -10; j <= 10; ++j)
    {
      if (std::max(std::abs(i), std::abs(j)) >= 2)
      {
        add({ 0.5 * i, 0.5 * j, 0 });
      }
    }
  }
  for (int i = -4; i <= 4; ++i)
  {
    for (int j = 0; j <= 8; ++j)
    {
      add({ 0.25 * i, 0.25 * (j - 4), 2 });
      for (const double side : { -1.0, 1.0 })
      {
        add({ 0.25 * i, side, 0.25 * j });
        add({ side, 0.25 * i, 0.25 * j });
      }
    }
  }
  return view;
}

/// The views of all cameras.
inline vtkSmartPointer<vtkMultiBlockDataSet> BlockFeatures()
{
  const BlockScene scene;
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (int i = 0; i < BlockCameras; ++i)
  {
    const freespace::View view = BlockView(scene, i);
    freespace::SetNamedBlock(blocks, i, view.name, freespace::BlockFromView(view));
  }
  return blocks;
}

#endif
