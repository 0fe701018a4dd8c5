// SPDX-License-Identifier: BSD-3-Clause
#include "Patches/WindowWarp.h"

#include <Eigen/Core>

#include <gtest/gtest.h>

#include <random>

using namespace freespace;

namespace
{

cv::Mat1f RandomImage(int columns, int rows)
{
  cv::Mat1f image(rows, columns);
  cv::RNG random(5);
  random.fill(image, cv::RNG::UNIFORM, 0, 255);
  return image;
}

// Bilinear interpolation in double precision.
double ValueAt(const cv::Mat1f& image, double x, double y)
{
  const int left = std::min(static_cast<int>(x - 0.5), image.cols - 2);
  const int top = std::min(static_cast<int>(y - 0.5), image.rows - 2);
  const double fx = x - 0.5 - left, fy = y - 0.5 - top;
  return (1 - fy) * ((1 - fx) * image(top, left) + fx * image(top, left + 1)) +
    fy * ((1 - fx) * image(top + 1, left) + fx * image(top + 1, left + 1));
}

Eigen::Vector3d WarpedAt(const PlaneWarp& warp, double column, double row, double disparity)
{
  Eigen::Vector3d at;
  for (std::size_t i = 0; i < 3; ++i)
  {
    at[static_cast<Eigen::Index>(i)] = warp.origin[i] + column * warp.alongColumn[i] +
      row * warp.alongRow[i] + disparity * warp.perDisparity[i];
  }
  return at;
}

}

TEST(WindowWarp, ReadsAsBruteForceDoes)
{
  const cv::Mat1f image = RandomImage(60, 50);
  std::mt19937 random(9);
  std::uniform_real_distribution<float> unit(-1, 1);
  for (int radius = 1; radius <= 7; ++radius)
  {
    const WindowPixels window(radius);
    ASSERT_EQ(window.count, (2 * radius + 1) * (2 * radius + 1));
    const PlaneWarp warp{ { 30 + 3 * unit(random), 25 + 3 * unit(random), 1 },
      { 1 + 0.2f * unit(random), 0.2f * unit(random), 0.002f * unit(random) },
      { 0.2f * unit(random), 1 + 0.2f * unit(random), 0.002f * unit(random) },
      { 5 * unit(random), 5 * unit(random), 0.1f * unit(random) } };
    WindowPixels::Values values, slopes;
    ASSERT_TRUE(WarpWindow(window, warp, image, values, slopes));
    for (std::size_t i = 0; i < static_cast<std::size_t>(window.count); ++i)
    {
      const double step = 1e-7;
      const Eigen::Vector3d at = WarpedAt(warp, window.column[i], window.row[i], 0);
      const Eigen::Vector3d moved = WarpedAt(warp, window.column[i], window.row[i], step);
      const double value = ValueAt(image, at.x() / at.z(), at.y() / at.z());
      const double slope =
        (ValueAt(image, moved.x() / moved.z(), moved.y() / moved.z()) - value) / step;
      EXPECT_NEAR(values[i], value, 0.01);
      EXPECT_NEAR(slopes[i], slope, 0.01 * (1 + std::abs(slope)));
    }
  }
}

TEST(WindowWarp, NothingWhereAPixelIsOutside)
{
  const cv::Mat1f image = RandomImage(60, 50);
  const WindowPixels window(2);
  WindowPixels::Values values, slopes;
  const auto isInside = [&](float x, float y, float z)
  {
    const PlaneWarp warp{ { x, y, z }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 } };
    return WarpWindow(window, warp, image, values, slopes);
  };
  EXPECT_TRUE(isInside(2.5f, 2.5f, 1));
  EXPECT_TRUE(isInside(57.4f, 47.4f, 1));
  EXPECT_FALSE(isInside(2.4f, 25, 1));
  EXPECT_FALSE(isInside(25, 2.4f, 1));
  EXPECT_FALSE(isInside(57.6f, 25, 1));
  EXPECT_FALSE(isInside(25, 47.6f, 1));
  EXPECT_FALSE(isInside(25, 25, -1)); // behind the camera
  EXPECT_FALSE(isInside(25, 25, 0));
  EXPECT_FALSE(isInside(std::numeric_limits<float>::quiet_NaN(), 25, 1));
}

TEST(WindowWarp, SumsAreThoseOfAPlainLoop)
{
  std::mt19937 random(4);
  std::uniform_real_distribution<float> unit(-1, 1);
  const WindowPixels window(3);
  WindowPixels::Values values, slopes, reference{}, weights{};
  values.fill(1e6f); // what the padding holds must not count
  slopes.fill(1e6f);
  double value = 0, square = 0, product = 0, slope = 0, s = 0, scr = 0, rc = 0, residuals = 0;
  const float gain = 1.5f, mean = 0.2f, slopeMean = -0.1f;
  for (std::size_t i = 0; i < static_cast<std::size_t>(window.count); ++i)
  {
    values[i] = unit(random);
    slopes[i] = unit(random);
    reference[i] = unit(random);
    weights[i] = std::abs(unit(random));
    value += values[i];
    square += values[i] * values[i];
    product += values[i] * reference[i];
    slope += slopes[i];
    const double d = gain * (slopes[i] - slopeMean);
    const double r = gain * (values[i] - mean) - reference[i];
    s += weights[i] * d * d;
    scr += weights[i] * d * d * window.column[i] * window.row[i];
    rc += weights[i] * d * r * window.column[i];
    residuals += weights[i] * r * r;
  }
  const WindowMoments moments = MomentsOf(window, values, slopes, reference);
  EXPECT_NEAR(moments.value, value, 1e-4);
  EXPECT_NEAR(moments.square, square, 1e-4);
  EXPECT_NEAR(moments.product, product, 1e-4);
  EXPECT_NEAR(moments.slope, slope, 1e-4);
  const WindowSums sums =
    SumWindow(window, values, slopes, reference, weights, gain, mean, slopeMean);
  EXPECT_NEAR(sums.s, s, 1e-3);
  EXPECT_NEAR(sums.scr, scr, 1e-3);
  EXPECT_NEAR(sums.rc, rc, 1e-3);
  EXPECT_NEAR(sums.residuals, residuals, 1e-3);
}
