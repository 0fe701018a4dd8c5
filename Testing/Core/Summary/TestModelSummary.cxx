// SPDX-License-Identifier: BSD-3-Clause
#include "Summary/ModelSummary.h"

#include "Common/Error.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace freespace;

namespace
{

SparseCamera Pinhole()
{
  SparseCamera camera;
  camera.id = 1;
  camera.width = 640;
  camera.height = 480;
  camera.parameters = { 500, 500, 320, 240 };
  return camera;
}

// A camera at (x, 0, 0) that sees the points.
SparseImage ImageAt(std::uint32_t id, double x, const std::vector<std::uint64_t>& points)
{
  SparseImage image;
  image.id = id;
  image.name = std::to_string(id) + ".jpg";
  image.camera = 1;
  image.translation = { -x, 0, 0 };
  for (std::uint64_t point : points)
  {
    image.observations.push_back({ { 1, 1 }, point });
  }
  return image;
}

SparsePoint PointAt(std::uint64_t id, const Eigen::Vector3d& position, double error)
{
  SparsePoint point;
  point.id = id;
  point.position = position;
  point.error = error;
  return point;
}

}

TEST(ModelSummary, CountsTracksAndMeasuresAngles)
{
  SparseModel model;
  model.cameras = { Pinhole() };
  // A keypoint of no point, and one of a point that the model does not hold, do not count.
  model.images = { ImageAt(1, 0, { 7, 8, SparseObservation::noPoint }), ImageAt(2, 1, { 7, 99 }),
    ImageAt(3, -1, { 7 }) };
  model.points = { PointAt(7, { 0, 0, 1 }, 0.5), PointAt(8, { 0, 0, 3 }, -1),
    PointAt(9, { 4, 0, 1 }, 1.5) };
  const ModelSummary summary = Summarize(model);
  EXPECT_EQ(summary.cameras, 1u);
  EXPECT_EQ(summary.images, 3u);
  EXPECT_EQ(summary.points, 3u);
  EXPECT_EQ(summary.observations, 4u);
  EXPECT_EQ(summary.trackLengths.count, 2u);
  EXPECT_EQ(summary.trackLengths.least, 1);
  EXPECT_EQ(summary.trackLengths.greatest, 3);
  EXPECT_EQ(summary.angles.count, 1u);
  EXPECT_NEAR(summary.angles.median, 90, 1e-12) << "between (1, 0, 0) and (-1, 0, 0) at (0, 0, 1)";
  EXPECT_EQ(summary.errors.count, 2u);
  EXPECT_EQ(summary.errors.median, 1.5);
  EXPECT_EQ(summary.centers.sizes(), Eigen::Vector3d(2, 0, 0));
  EXPECT_EQ(summary.bounds.max(), Eigen::Vector3d(4, 0, 3));
}

TEST(ModelSummary, TakesLongTracksAndNothing)
{
  SparseModel model;
  EXPECT_EQ(Summarize(model).angles.count, 0u);
  model.cameras = { Pinhole() };
  for (std::uint32_t i = 0; i < 200; ++i)
  {
    model.images.push_back(ImageAt(i + 1, 0.01 * i, { 1 }));
  }
  model.points = { PointAt(1, { 0, 0, 1 }, 0) };
  const ModelSummary summary = Summarize(model);
  EXPECT_EQ(summary.trackLengths.median, 200);
  EXPECT_NEAR(summary.angles.median, std::atan(1.9) * 180 / M_PI, 1e-9) << "19 of 20 of the way";
}

TEST(ModelSummary, RefusesAnImageOfNoCamera)
{
  SparseModel model;
  model.images = { ImageAt(1, 0, {}) };
  EXPECT_THROW(Summarize(model), Error);
}

TEST(Spread, IsOfWhatIsFinite)
{
  const Spread spread = SpreadOf({ 3, std::nan(""), 1, HUGE_VAL, 2 });
  EXPECT_EQ(spread.count, 3u);
  EXPECT_EQ(spread.least, 1);
  EXPECT_EQ(spread.median, 2);
  EXPECT_EQ(spread.greatest, 3);
  EXPECT_EQ(SpreadOf({}).count, 0u);
}
