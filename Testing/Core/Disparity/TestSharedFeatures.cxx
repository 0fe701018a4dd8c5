// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/Outliers/SharedFeatures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace freespace;
using Eigen::Vector3d;

TEST(SharedFeatures, ViewsAreCountedOnceForEachPlace)
{
  std::vector<View> views(3);
  views[0].points = { { 1, 2, 3 }, { 1, 2, 3 }, { 0, 0, 0 } };
  views[1].points = { { 1, 2, 3 }, { NAN, 0, 0 } };
  views[2].points = { { 1, 2, std::nextafter(3, 4) }, { NAN, 0, 0 } };
  const SharedFeatures shared(views);
  EXPECT_EQ(shared.ViewsWith({ 1, 2, 3 }), 2) << "twice in the first";
  EXPECT_EQ(shared.ViewsWith({ 1, 2, std::nextafter(3, 4) }), 1) << "exactly the same place counts";
  EXPECT_EQ(shared.ViewsWith({ 0, 0, 0 }), 1);
  EXPECT_EQ(shared.ViewsWith({ -0.0, 0, -0.0 }), 1);
  EXPECT_EQ(shared.ViewsWith({ 5, 5, 5 }), 0);
  EXPECT_EQ(shared.ViewsWith({ NAN, 0, 0 }), 0) << "what is not finite is nowhere";
  EXPECT_EQ(SharedFeatures({}).ViewsWith({ 0, 0, 0 }), 0);
}

TEST(SharedFeatures, AgreeWithACount)
{
  std::mt19937 random(1);
  std::vector<View> views(12);
  const auto place = [&] { return static_cast<double>(random() % 6); };
  for (View& view : views)
  {
    for (int i = 0; i < 80; ++i)
    {
      view.points.emplace_back(place(), place(), place());
    }
  }
  const SharedFeatures shared(views);
  for (int x = 0; x < 6; ++x)
  {
    for (int y = 0; y < 6; ++y)
    {
      for (int z = 0; z < 6; ++z)
      {
        const Vector3d point(x, y, z);
        int count = 0;
        for (const View& view : views)
        {
          count += std::find(view.points.begin(), view.points.end(), point) != view.points.end();
        }
        EXPECT_EQ(shared.ViewsWith(point), count);
      }
    }
  }
}
