// SPDX-License-Identifier: BSD-3-Clause
#include "Texture/SurfaceColor.h"

#include "Support/Scenes/BlockScene.h"

#include <gtest/gtest.h>

using namespace freespace;

TEST(SurfaceColor, ExposuresAreLevelled)
{
  BlockScene scene;
  std::vector<Photograph> photographs;
  for (int i = 0; i < 6; ++i)
  {
    photographs.push_back(scene.Take(scene.CameraAt(i), "p"));
    for (unsigned char& value : photographs.back().rgb)
    {
      value = static_cast<unsigned char>(i % 2 ? 0.7 * value : value);
    }
  }
  TriangleMesh fine; // levelling compares the middles of triangles
  for (int i = 0; i < 40 * 40; ++i)
  {
    const Eigen::Vector3d corner(-5 + i % 40 * 0.25, -5 + i / 40 * 0.25, 0);
    const int first = static_cast<int>(fine.points.size());
    fine.points.push_back(corner);
    fine.points.push_back(corner + Eigen::Vector3d(0.25, 0, 0));
    fine.points.push_back(corner + Eigen::Vector3d(0, 0.25, 0));
    fine.triangles.push_back({ first, first + 1, first + 2 });
  }
  const TriangleMesh block = scene.Mesh();
  const int first = static_cast<int>(fine.points.size());
  fine.points.insert(fine.points.end(), block.points.begin(), block.points.end());
  for (const auto& [a, b, c] : block.triangles)
  {
    fine.triangles.push_back({ first + a, first + b, first + c });
  }
  const SurfaceColor color(fine, photographs);
  for (int channel = 1; channel < 3; ++channel)
  {
    EXPECT_NEAR(color.Gains()[1][channel] / color.Gains()[0][channel], 1 / 0.7, 0.03);
    EXPECT_NEAR(color.Gains()[4][channel] / color.Gains()[2][channel], 1, 0.03);
  }
}
