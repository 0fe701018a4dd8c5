// SPDX-License-Identifier: BSD-3-Clause
#include "Epipolar/DisparityRange.h"

#include "Support/Core/RandomCameras.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

using namespace freespace;

namespace
{

Camera RandomCamera(std::mt19937& random)
{
  std::uniform_real_distribution<double> unit(-1, 1);
  Camera camera = ParallelCamera(0);
  camera.R = Eigen::AngleAxisd(
    0.4 * unit(random), Eigen::Vector3d(unit(random), unit(random), unit(random)).normalized())
               .toRotationMatrix();
  camera.t = Eigen::Vector3d(unit(random), unit(random), unit(random));
  return camera;
}

bool IsSeen(const Camera& camera, const Eigen::Vector3d& point)
{
  return camera.Depth(point) > 0 && camera.Sees(camera.Project(point));
}

}

// The pixel moves to the left by 500 * baseline * disparity, until it leaves the image.
TEST(VisibleRange, OfParallelCameras)
{
  const DisparityRange within{ 0, 10 };
  const DisparityRange range =
    VisibleRange(ParallelCamera(0), { 400, 100 }, ParallelCamera(0.5), within);
  EXPECT_NEAR(range.minimum, 0, 1e-12);
  EXPECT_NEAR(range.maximum, 400 / 250.0, 1e-9);
  // The camera on the left: to the right, by 640 - 400 pixels.
  EXPECT_NEAR(VisibleRange(ParallelCamera(0), { 400, 100 }, ParallelCamera(-0.5), within).maximum,
    240 / 250.0, 1e-9);
  // What is asked for bounds the range.
  const DisparityRange narrow =
    VisibleRange(ParallelCamera(0), { 400, 100 }, ParallelCamera(0.5), { 0.25, 0.75 });
  EXPECT_NEAR(narrow.minimum, 0.25, 1e-12);
  EXPECT_NEAR(narrow.maximum, 0.75, 1e-12);
  EXPECT_TRUE(VisibleRange(ParallelCamera(0), { 400, 100 }, ParallelCamera(0.5), { 2, 3 }).Empty());
}

TEST(VisibleRange, IsWhereThePointIsSeen)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(0, 640), v(0, 480), disparity(0.01, 3);
  int seen = 0, unseen = 0;
  for (int trial = 0; trial < 300; ++trial)
  {
    const Camera reference = RandomCamera(random), other = RandomCamera(random);
    const Eigen::Vector2d pixel(u(random), v(random));
    const DisparityRange range = VisibleRange(reference, pixel, other, { 0.01, 3 });
    for (int sample = 0; sample < 20; ++sample)
    {
      const double d = disparity(random);
      if (std::min(std::abs(d - range.minimum), std::abs(d - range.maximum)) < 1e-9)
      {
        continue;
      }
      const bool isIn = !range.Empty() && d > range.minimum && d < range.maximum;
      ASSERT_EQ(isIn, IsSeen(other, reference.Unproject(pixel, 1 / d))) << trial << " at " << d;
      ++(isIn ? seen : unseen);
    }
  }
  EXPECT_GT(seen, 1000) << "both happen often";
  EXPECT_GT(unseen, 1000);
}

// Between the cameras at -1 and 1 a disparity d moves pixels by 500 d to either side: some point is seen by all until
// the overlap, 640 pixels wide at infinity, is gone at 2 * 500 d = 640. The reference's grid may just miss the end.
TEST(CommonRange, OfThreeCamerasInARow)
{
  const DisparityRange range =
    CommonRange(ParallelCamera(0), ParallelCamera(-1), ParallelCamera(1), { 0, 10 });
  EXPECT_NEAR(range.minimum, 0, 1e-12);
  EXPECT_LE(range.maximum, 0.64 + 1e-9);
  EXPECT_GT(range.maximum, 0.6);
}

TEST(CommonRange, WithoutOverlapIsEmpty)
{
  Camera away = ParallelCamera(1);
  away.R = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitY()).toRotationMatrix();
  EXPECT_TRUE(CommonRange(ParallelCamera(0), ParallelCamera(-1), away, { 0, 10 }).Empty());
}

TEST(VisibleRange, AgreesWithSampling)
{
  int seen = 0;
  for (unsigned int seed = 0; seed < 60; ++seed)
  {
    RandomCameras random(seed);
    const Camera reference = random.Next(), other = random.Next();
    const Eigen::Vector2d pixel(random.Uniform(0, 240), random.Uniform(0, 180));
    const DisparityRange range = VisibleRange(reference, pixel, other, { 0.05, 20 });
    for (double disparity = 0.06; disparity < 20; disparity *= 1.07)
    {
      const Eigen::Vector3d point = reference.Unproject(pixel, 1 / disparity);
      const bool visible = other.Depth(point) > 0 && other.Sees(other.Project(point));
      EXPECT_EQ(visible, disparity >= range.minimum && disparity <= range.maximum)
        << seed << " " << disparity;
      seen += visible;
    }
  }
  EXPECT_GT(seen, 500);
}

TEST(CommonRange, CamerasThatLookApartHaveNone)
{
  const double infinity = std::numeric_limits<double>::infinity();
  const Camera ahead = LookAt({ 0, 0, 0 }, { 0, 0, 1 });
  EXPECT_FALSE(CommonRange(
    ahead, LookAt({ -0.1, 0, 0 }, { 0, 0, 1 }), LookAt({ 0.1, 0, 0 }, { 0, 0, 1 }), { 0, infinity })
                 .Empty());
  EXPECT_TRUE(CommonRange(ahead, LookAt({ -0.1, 0, 0 }, { -1, 0, -1 }),
    LookAt({ 0.1, 0, 0 }, { 0, 0, 1 }), { 0, infinity })
                .Empty());
  EXPECT_TRUE(CommonRange(
    ahead, LookAt({ -0.1, 0, 0 }, { 0, 0, 1 }), LookAt({ 0.1, 0, 0 }, { 0, 0, 1 }), { 1e4, 1e5 })
                .Empty()); // too near
}
