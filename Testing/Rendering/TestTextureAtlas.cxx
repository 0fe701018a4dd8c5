// SPDX-License-Identifier: BSD-3-Clause
#include "Texture/TextureAtlas.h"

#include "Common/Error.h"
#include "Support/Scenes/BlockScene.h"

#include <gtest/gtest.h>

using namespace freespace;

TEST(TextureAtlas, OneTooSmallForItsChartsIsAnError)
{
  BlockScene scene;
  std::vector<Photograph> photographs;
  for (int i = 0; i < 6; ++i)
  {
    photographs.push_back(scene.Take(scene.CameraAt(i), "p"));
  }
  const TriangleMesh mesh = scene.Mesh();
  const SurfaceColor color(mesh, photographs);
  TextureAtlasOptions options;
  options.largest = 16;
  options.gutter = 7; // a chart keeps sixteen texels square, however coarse they are
  EXPECT_THROW(BakeTexture(mesh, color, options), Error);
}
