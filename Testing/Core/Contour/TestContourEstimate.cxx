// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/Lattice/ContourEstimate.h"

#include "Common/Error.h"
#include "Contour/BisectionContour.h"
#include "Freespace/FreespaceUnion.h"
#include "Support/ContourFields.h"
#include "Support/RandomMaps.h"

#include <gtest/gtest.h>

using namespace freespace;
using Eigen::AlignedBox3d;

TEST(ContourEstimate, EstimatesItsSize)
{
  // The paper's union with a thin margin, so that the area does not depend on the lattice.
  FreespaceUnionOptions options;
  options.minimumViews = 1;
  options.hullMargin = 0.01;
  const FreespaceUnion phi(RandomMaps(6, 3), options);
  const AlignedBox3d bounds = phi.Hull().Bounds();
  for (int cells : { 120, 300 })
  {
    const double triangles = BisectionContour(phi, bounds, Cells(cells)).triangles.size();
    const double estimate = EstimateContour(phi, bounds, Cells(cells)).triangles;
    EXPECT_NEAR(estimate / triangles, 1.0, 0.15) << cells;
  }
  // What nobody could make is known as quickly: four times as much for every halved cell.
  const double some = EstimateContour(phi, bounds, Cells(240)).megabytes;
  const double many = EstimateContour(phi, bounds, Cells(256 * 240)).megabytes;
  EXPECT_NEAR(many / some / (256.0 * 256.0), 1.0, 0.15);
  EXPECT_EQ(EstimateContour(Ball(), Cube(1.3), Cells(100)).triangles, 0); // answers for points only
}

TEST(ContourEstimate, KeepsToItsMemoryLimit)
{
  const FreespaceUnion phi(RandomMaps(6, 3), {});
  const AlignedBox3d bounds = phi.Hull().Bounds();
  ContourOptions options = Cells(150);
  const double needed = EstimateContour(phi, bounds, options).megabytes;
  ASSERT_GT(needed, 1);
  options.memoryLimit = 1.3 * needed;
  const std::size_t triangles = BisectionContour(phi, bounds, options).triangles.size();
  options.memoryLimit = needed / 2;
  EXPECT_THROW(BisectionContour(phi, bounds, options), Error);
  options.pieces = 4; // each of which fits
  std::size_t sum = 0;
  for (options.piece = 0; options.piece < 4; ++options.piece)
  {
    sum += BisectionContour(phi, bounds, options).triangles.size();
  }
  EXPECT_EQ(sum, triangles);
  ContourOptions large = Cells(65536);
  large.memoryLimit = 1000;
  EXPECT_THROW(BisectionContour(phi, bounds, large), Error);
  // A field that cannot tell is stopped when it has become too large.
  ContourOptions untold = Cells(100);
  untold.memoryLimit = 0.1;
  EXPECT_THROW(BisectionContour(Ball(), Cube(1.3), untold), Error);
  untold.memoryLimit = -1;
  EXPECT_THROW(BisectionContour(Ball(), Cube(1.3), untold), Error);
}
