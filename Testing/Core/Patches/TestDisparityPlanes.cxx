// SPDX-License-Identifier: BSD-3-Clause
#include "Patches/DisparityPlanes.h"

#include "Common/Error.h"

#include <gtest/gtest.h>

#include <functional>

using namespace freespace;

namespace
{

// Features on a grid of pixels, with a disparity that is given in the image.
View ViewOf(const std::function<double(const Eigen::Vector2d&)>& disparity)
{
  View view;
  view.name = "view";
  view.camera.width = 120;
  view.camera.height = 100;
  view.camera.K << 100, 0, 60, 0, 100, 50, 0, 0, 1;
  for (double row = 10; row <= 90; row += 8)
  {
    for (double column = 10; column <= 110; column += 8)
    {
      const Eigen::Vector2d pixel(column, row);
      view.imagePoints.push_back(pixel);
      view.points.push_back(view.camera.Unproject(pixel, 1 / disparity(pixel)));
    }
  }
  return view;
}

}

TEST(DisparityPlanes, PlaneIsExact)
{
  const auto plane = [](const Eigen::Vector2d& pixel)
  { return 1 + 2e-3 * pixel.x() - 1e-3 * pixel.y(); };
  const DisparityPlanes planes(ViewOf(plane));
  PatchPlane found;
  double roughness = 1;
  for (const Eigen::Vector2d& pixel : { Eigen::Vector2d(40.3, 30.9), Eigen::Vector2d(80, 66) })
  {
    ASSERT_TRUE(planes.Fit(pixel, found, roughness));
    EXPECT_EQ(found.pixel, pixel);
    EXPECT_NEAR(found.disparity, plane(pixel), 1e-6);
    EXPECT_NEAR(found.slope.x(), 2e-3, 1e-6);
    EXPECT_NEAR(found.slope.y(), -1e-3, 1e-6);
    EXPECT_LT(roughness, 1e-3);
  }
}

TEST(DisparityPlanes, RoughnessIsTheDeviationFromThePlane)
{
  // A ridge along x = 58, of slopes +-s: over 13 columns the deviation of s |x| from its mean.
  const double s = 4e-3;
  const DisparityPlanes planes(
    ViewOf([=](const Eigen::Vector2d& pixel) { return 1 - s * std::abs(pixel.x() - 58); }));
  PatchPlane found;
  double roughness = 0;
  ASSERT_TRUE(planes.Fit({ 58, 50 }, found, roughness));
  EXPECT_NEAR(roughness, s * 2, 0.3 * s); // of |x| at -6, -4, ... 6: standard deviation 2.1
  EXPECT_NEAR(found.slope.x(), 0, 2e-3);
}

TEST(DisparityPlanes, NoneAtADepthJump)
{
  const DisparityPlanes planes(
    ViewOf([](const Eigen::Vector2d& pixel) { return pixel.x() < 60 ? 1.0 : 3.0; }));
  PatchPlane found;
  double roughness = 0;
  EXPECT_FALSE(planes.Fit({ 62, 50 }, found, roughness));
  EXPECT_TRUE(planes.Fit({ 30, 50 }, found, roughness));
  EXPECT_TRUE(planes.Fit({ 90, 50 }, found, roughness));
}

TEST(DisparityPlanes, NoneOutsideTheFeatures)
{
  const DisparityPlanes planes(ViewOf([](const Eigen::Vector2d&) { return 1.0; }));
  PatchPlane found;
  double roughness = 0;
  for (const Eigen::Vector2d& pixel :
    { Eigen::Vector2d(8, 50), Eigen::Vector2d(60, 97), Eigen::Vector2d(-1e6, 50) })
  {
    EXPECT_FALSE(planes.Fit(pixel, found, roughness)) << pixel.transpose();
  }
}

TEST(DisparityPlanes, CollinearFeatures)
{
  View view = ViewOf([](const Eigen::Vector2d&) { return 1.0; });
  view.points.resize(10);
  view.imagePoints.resize(10);
  EXPECT_THROW(DisparityPlanes{ view }, Error);
}
