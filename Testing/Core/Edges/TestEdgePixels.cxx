// SPDX-License-Identifier: BSD-3-Clause
#include "Edges/EdgePixels.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

using namespace freespace;

namespace
{

// A step from 60 to 180 across the vertical x = place; the pixel that it cuts has the mean.
cv::Mat Step(double place, int width = 60, int height = 40)
{
  cv::Mat image(height, width, CV_8U);
  for (int x = 0; x < width; ++x)
  {
    const double bright = std::min(std::max(x + 1.0 - place, 0.0), 1.0); // of the pixel [x, x + 1]
    image.col(x) = std::lround(60 + 120 * bright);
  }
  return image;
}

}

// One point a row, at the step, linked to those above and below.
TEST(EdgePixels, OfAStep)
{
  for (const double place : { 29.5, 29.75, 30.0, 30.25 })
  {
    const LinkedPoints found = FindEdgePixels(Step(place), 1, 1.8);
    ASSERT_EQ(found.points.size(), 38u) << "the first and the last row have no slope";
    for (std::size_t i = 0; i < found.points.size(); ++i)
    {
      EXPECT_NEAR(found.points[i].x, place - 0.5, 0.05) << place;
      EXPECT_EQ(found.points[i].y, static_cast<float>(i + 1));
      // The gradient points to the right of the way: up the image it is to the right.
      EXPECT_EQ(found.next[i], static_cast<int>(i) - 1);
      EXPECT_EQ(found.previous[i], i + 1 < found.points.size() ? static_cast<int>(i) + 1 : -1);
    }
  }
}

// Each link is one back.
TEST(EdgePixels, LinksAreMutual)
{
  cv::Mat image(80, 80, CV_8U, cv::Scalar(40));
  cv::circle(image, { 40, 40 }, 20, { 200 }, cv::FILLED, cv::LINE_AA);
  cv::rectangle(image, cv::Rect(5, 60, 15, 15), { 150 }, cv::FILLED);
  const LinkedPoints found = FindEdgePixels(image, 1, 1.8);
  const int count = static_cast<int>(found.points.size());
  EXPECT_NEAR(count, 4 * std::sqrt(2.0) * 20 + 4 * 15, 20)
    << "a pixel for each step along both outlines";
  for (int i = 0; i < count; ++i)
  {
    if (found.next[i] >= 0)
    {
      ASSERT_LT(found.next[i], count);
      EXPECT_EQ(found.previous[found.next[i]], i);
    }
    if (found.previous[i] >= 0)
    {
      EXPECT_EQ(found.next[found.previous[i]], i);
    }
  }
}

TEST(EdgePixels, OfOneChannelOrThree)
{
  const cv::Mat grey = Step(30);
  cv::Mat color;
  cv::cvtColor(grey, color, cv::COLOR_GRAY2BGR);
  const LinkedPoints one = FindEdgePixels(grey, 1, 1.8), three = FindEdgePixels(color, 1, 1.8);
  ASSERT_EQ(one.points.size(), three.points.size());
  for (std::size_t i = 0; i < one.points.size(); ++i)
  {
    EXPECT_EQ(one.points[i].x, three.points[i].x);
    EXPECT_EQ(one.points[i].y, three.points[i].y);
  }
}

TEST(EdgePixels, NoneInFlatOrTinyImages)
{
  EXPECT_TRUE(FindEdgePixels(cv::Mat(40, 60, CV_8U, cv::Scalar(128)), 1, 1.8).points.empty());
  EXPECT_TRUE(FindEdgePixels(cv::Mat(1, 1, CV_8U, cv::Scalar(128)), 1, 1.8).points.empty());
  EXPECT_TRUE(FindEdgePixels(Step(1, 2, 40), 1, 1.8).points.empty()) << "no inner pixel";
}
