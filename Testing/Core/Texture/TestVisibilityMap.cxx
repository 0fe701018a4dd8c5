// SPDX-License-Identifier: BSD-3-Clause
#include "Texture/VisibilityMap.h"

#include "Common/Error.h"
#include "Support/Core/SmallImage.h"

#include <gtest/gtest.h>

using namespace freespace;

TEST(VisibilityMap, FarSideOfAnOcclusionIsMasked)
{
  const Camera camera = SmallCamera();
  TriangleMesh mesh;
  AddSquare(mesh, camera, -500, 500, 4.0);
  AddSquare(mesh, camera, -500, 20.3, 2.0);
  VisibilityOptions options;
  options.feather = 4;
  const VisibilityMap map = MakeVisibilityMap(mesh, camera, options);
  EXPECT_GT(map.At({ 12, 15 }, 2.0), 0.9) << "the near square";
  EXPECT_EQ(map.At({ 12, 15 }, 4.0), 0.0) << "hidden behind it";
  EXPECT_GT(map.At({ 20.4, 15 }, 4.0), 0.0) << "beside its edge, but";
  EXPECT_LE(map.At({ 20.4, 15 }, 4.0), MaskedConfidence) << "masked";
  EXPECT_GT(map.At({ 23.5, 15 }, 4.0), 0.1) << "three pixels beside";
  EXPECT_GT(map.At({ 28, 15 }, 4.0), 0.9) << "far beside";
  EXPECT_GT(map.At({ 19.5, 15 }, 2.0), 0.0) << "the near square's rim is still seen";
  EXPECT_LT(map.At({ 19.5, 15 }, 2.0), 0.5);
}

TEST(VisibilityMap, MaskedPixelsTakeTheColourOfTheirSide)
{
  const Camera camera = SmallCamera();
  TriangleMesh mesh;
  AddSquare(mesh, camera, -500, 500, 4.0);
  AddSquare(mesh, camera, -500, 20.3, 2.0);
  VisibilityOptions options;
  options.jump = 2;
  const VisibilityMap map = MakeVisibilityMap(mesh, camera, options);
  Photograph photograph; // the near square is red and stains two pixels of the grey far one
  photograph.camera = camera;
  for (int i = 0; i < 40 * 30; ++i)
  {
    const unsigned char red = i % 40 < 22 ? 250 : 90;
    const unsigned char other = i % 40 < 22 ? 0 : 90;
    photograph.rgb.insert(photograph.rgb.end(), { red, other, other });
  }
  FillMasked(map, photograph);
  for (int column = 1; column < 39; ++column)
  {
    EXPECT_EQ(photograph.rgb[3 * (15 * 40 + column)], column < 20 ? 250 : 90) << column;
  }
}

TEST(VisibilityMap, SteepPlaneIsNoOcclusion)
{
  const Camera camera = SmallCamera();
  TriangleMesh mesh; // depth 1 at the left border, 20 at the right one
  AddTriangle(mesh, camera.Unproject({ 0, -200 }, 1), camera.Unproject({ 40, -200 }, 20),
    camera.Unproject({ 40, 230 }, 20));
  AddTriangle(mesh, camera.Unproject({ 0, -200 }, 1), camera.Unproject({ 40, 230 }, 20),
    camera.Unproject({ 0, 230 }, 1));
  VisibilityOptions options;
  options.feather = 2;
  const VisibilityMap map = MakeVisibilityMap(mesh, camera, options);
  for (int column = 3; column < 37; ++column)
  {
    const double depth = 1 / (1 + (column + 0.25) / 40 * (1.0 / 20 - 1));
    EXPECT_EQ(map.At({ column + 0.25, 15.3 }, depth), 1.0) << column;
  }
}

TEST(VisibilityMap, NothingIsSeenBeyondTheImageOrBehindTheCamera)
{
  const Camera camera = SmallCamera();
  TriangleMesh mesh;
  AddSquare(mesh, camera, -500, 500, 4.0);
  const VisibilityMap map = MakeVisibilityMap(mesh, camera);
  EXPECT_EQ(map.At({ -1, 15 }, 4.0), 0.0);
  EXPECT_EQ(map.At({ 41, 15 }, 4.0), 0.0);
  EXPECT_EQ(map.At({ 20, 31 }, 4.0), 0.0);
  EXPECT_EQ(map.At({ 20, 15 }, -4.0), 0.0);
}

TEST(VisibilityMap, RefusesOptionsOutOfRange)
{
  VisibilityOptions options;
  options.feather = 0;
  EXPECT_THROW(MakeVisibilityMap({}, SmallCamera(), options), Error);
}
