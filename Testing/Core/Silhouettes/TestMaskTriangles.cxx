// SPDX-License-Identifier: BSD-3-Clause
#include "Silhouettes/MaskTriangles.h"

#include <opencv2/imgproc.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace freespace;
using Eigen::Vector2d;

namespace
{

// How many times the triangles cover each pixel's centre, by brute force.
cv::Mat Coverage(const PlanarTriangles& triangles, cv::Size size)
{
  cv::Mat times = cv::Mat::zeros(size, CV_32S);
  for (const auto& corners : triangles.triangles)
  {
    for (int row = 0; row < size.height; ++row)
    {
      for (int column = 0; column < size.width; ++column)
      {
        // A little beside the centre, where no edge passes.
        const Vector2d p(column + 0.5 + 1e-5, row + 0.5 + 3.3e-6);
        bool isInside = true;
        for (int i = 0; i < 3; ++i)
        {
          const Vector2d& a = triangles.points[corners[i]];
          const Vector2d along = triangles.points[corners[(i + 1) % 3]] - a, to = p - a;
          isInside = isInside && along.x() * to.y() - along.y() * to.x() > 0;
        }
        times.at<int>(row, column) += isInside;
      }
    }
  }
  return times;
}

bool IsBlackAround(const cv::Mat& mask, int row, int column, int radius)
{
  for (int r = row - radius; r <= row + radius; ++r)
  {
    for (int c = column - radius; c <= column + radius; ++c)
    {
      if (r >= 0 && c >= 0 && r < mask.rows && c < mask.cols && mask.at<unsigned char>(r, c) != 0)
      {
        return false;
      }
    }
  }
  return true;
}

// Blobs of white, some of them with holes, and specks.
cv::Mat RandomMask(int seed)
{
  cv::RNG random(static_cast<std::uint64_t>(seed) + 1);
  cv::Mat mask = cv::Mat::zeros(48, 64, CV_8U);
  for (int i = 0; i < 5; ++i)
  {
    cv::circle(mask, cv::Point(random.uniform(0, 64), random.uniform(0, 48)), random.uniform(1, 14),
      cv::Scalar(random.uniform(0, 4) == 0 ? 0 : 255), cv::FILLED);
  }
  for (int i = 0; i < 6; ++i)
  {
    mask.at<unsigned char>(random.uniform(0, 48), random.uniform(0, 64)) = 128;
  }
  return mask;
}

}

TEST(MaskTriangles, CoverTheBlackPartsOnceAndNothingElse)
{
  for (int seed = 0; seed < 30; ++seed)
  {
    SCOPED_TRACE(seed);
    const cv::Mat mask = RandomMask(seed);
    const cv::Mat times = Coverage(MaskTriangles(mask), mask.size());
    int covered = 0;
    for (int row = 1; row + 1 < mask.rows; ++row)
    {
      for (int column = 1; column + 1 < mask.cols; ++column)
      {
        const int count = times.at<int>(row, column);
        ASSERT_LE(count, 1);
        // A pixel's centre is at the corner of what the contours through centres bound.
        ASSERT_TRUE(count == 0 || IsBlackAround(mask, row, column, 0)) << row << " " << column;
        ASSERT_TRUE(count == 1 || !IsBlackAround(mask, row, column, 2)) << row << " " << column;
        covered += count;
      }
    }
    EXPECT_GT(covered, 500);
  }
}

TEST(MaskTriangles, OfABlackImageReachItsBorder)
{
  const PlanarTriangles triangles = MaskTriangles(cv::Mat::zeros(30, 40, CV_8U));
  double area = 0;
  for (const auto& [a, b, c] : triangles.triangles)
  {
    const Vector2d ab = triangles.points[b] - triangles.points[a];
    const Vector2d ac = triangles.points[c] - triangles.points[a];
    area += (ab.x() * ac.y() - ab.y() * ac.x()) / 2;
    EXPECT_LT(std::min({ ab.norm(), ac.norm(), (ac - ab).norm() }), 40);
  }
  EXPECT_NEAR(area, 39 * 29, 1e-9); // between the centres of the outermost pixels
  // Straight pieces of the boundary are divided.
  EXPECT_GE(triangles.points.size(), 4u + 2 + 2);
}

TEST(MaskTriangles, OfAMaskWithoutBlackAreNone)
{
  EXPECT_TRUE(MaskTriangles(cv::Mat(20, 20, CV_8U, cv::Scalar(255))).triangles.empty());
  cv::Mat speck(20, 20, CV_8U, cv::Scalar(255));
  speck.at<unsigned char>(7, 9) = 0;
  EXPECT_TRUE(MaskTriangles(speck).triangles.empty());
}
