// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/SurfaceResolution.h"

#include "Common/Error.h"

#include <gtest/gtest.h>

#include <vector>

using namespace freespace;
using Eigen::AlignedBox3d;
using Eigen::Vector3d;

namespace
{

// At (0, -2, 0), it looks along y; focal length 1500 pixels.
Camera CameraTwoBefore()
{
  Camera camera;
  camera.K << 1500, 0, 750, 0, 1500, 500, 0, 0, 1;
  camera.width = 1500;
  camera.height = 1000;
  camera.R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  camera.t = -camera.R * Vector3d(0, -2, 0);
  return camera;
}

}

TEST(SurfaceResolution, GoesByFootprintAndSpacing)
{
  std::vector<ViewFeatures> views(1);
  views[0].camera = CameraTwoBefore();
  views[0].points = { { 0, 0, 0 }, { 0.1, 0, 0 }, { 0, 1000, 0 } };
  views[0].spacing = 10;
  ResolutionOptions options;
  const AlignedBox3d box(Vector3d(-1, -1, -1), Vector3d(1, 1, 1));
  EXPECT_NEAR(CellSide(views, box, options), options.cell * 10 * 2 / 1500, 1e-4);
  views[0].spacing = 0.1;
  EXPECT_NEAR(CellSide(views, box, options), options.pixels * 2 / 1500, 1e-4);
  EXPECT_EQ(CellSide({}, box, options), 0);
}

TEST(SurfaceResolution, CountsCellsAlongTheLongestSide)
{
  const AlignedBox3d box(Vector3d(0, 0, 0), Vector3d(1, 6, 2));
  ResolutionOptions options;
  EXPECT_EQ(CellsAlong(box, 0.02, options), 300);
  EXPECT_EQ(CellsAlong(box, 1, options), options.fewestCells);
  EXPECT_EQ(CellsAlong(box, 1e-6, options), options.mostCells);
  EXPECT_EQ(CellsAlong(box, 0, options), options.fewestCells);
  EXPECT_EQ(CellsAlong(AlignedBox3d(), 1, options), options.fewestCells);
  options.mostCells = 100;
  EXPECT_THROW(options.Check(), Error);
}
