// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/Outliers/ViolatedTriangles.h"

#include "Support/FeatureViews.h"

#include <gtest/gtest.h>

using namespace freespace;

namespace
{

// A square of two triangles at depth 2, pixels 400 to 600, its last corner at another depth.
DisparityMap SquareView(double lastDepth = 2)
{
  DisparityMap map;
  static_cast<View&>(map) = MakeView();
  AddFeature(map, Eigen::Vector2d(400, 400), 2);
  AddFeature(map, Eigen::Vector2d(600, 400), 2);
  AddFeature(map, Eigen::Vector2d(400, 600), 2);
  AddFeature(map, Eigen::Vector2d(600, 600), lastDepth);
  map.triangles = { { 0, 1, 2 }, { 1, 3, 2 } };
  return map;
}

// The map's own view and another one of the same camera, with these features.
std::vector<char> Violated(const DisparityMap& map,
  const std::vector<std::pair<Eigen::Vector2d, double>>& features, int least = 3)
{
  View other = MakeView();
  for (const auto& [pixel, depth] : features)
  {
    AddFeature(other, pixel, depth);
  }
  const FeatureCloud cloud({ map, other });
  return ViolatedTriangles(map, ViewFreespace(map), cloud, 0, least, 0.01);
}

using Pixel = Eigen::Vector2d;

}

TEST(ViolatedTriangles, ByEnoughFeaturesInFront)
{
  // Three before the first triangle, two before the second.
  const std::vector<char> violated = Violated(SquareView(),
    { { Pixel(450, 450), 1.5 }, { Pixel(460, 450), 1.5 }, { Pixel(450, 460), 1.5 },
      { Pixel(550, 550), 1.5 }, { Pixel(560, 550), 1.5 } });
  EXPECT_EQ(violated, (std::vector<char>{ 1, 0 }));
}

TEST(ViolatedTriangles, NotWhereAsManyFeaturesAgree)
{
  const std::vector<std::pair<Pixel, double>> front = { { Pixel(450, 450), 1.5 },
    { Pixel(460, 450), 1.5 }, { Pixel(450, 460), 1.5 } };
  auto both = front;
  for (int i = 0; i < 3; ++i)
  {
    both.emplace_back(Pixel(430 + 5 * i, 430), 2.01); // within a hundredth of the depth
  }
  EXPECT_EQ(Violated(SquareView(), both), (std::vector<char>{ 0, 0 }));
  both.pop_back();
  EXPECT_EQ(Violated(SquareView(), both), (std::vector<char>{ 1, 0 }));
}

TEST(ViolatedTriangles, NotByFeaturesBehindOrOnIt)
{
  EXPECT_EQ(Violated(SquareView(),
              { { Pixel(450, 450), 2.5 }, { Pixel(460, 450), 3 }, { Pixel(450, 460), 1.99 },
                { Pixel(455, 455), 1.99 } }),
    (std::vector<char>{ 0, 0 }));
}

TEST(ViolatedTriangles, NotByTheViewsOwnFeatures)
{
  DisparityMap map = SquareView();
  for (int i = 0; i < 5; ++i)
  {
    AddFeature(map, Pixel(430 + 5 * i, 450), 1.5);
  }
  EXPECT_EQ(Violated(map, { { Pixel(900, 900), 2 } }), (std::vector<char>{ 0, 0 }));
}

TEST(ViolatedTriangles, OfAMapWithoutTriangles)
{
  DisparityMap map = SquareView();
  map.triangles.clear();
  EXPECT_TRUE(Violated(map, { { Pixel(450, 450), 1.5 } }).empty());
}

// The deepest corner is to blame when more than half of the triangles around it are violated.
TEST(ViolatedTriangles, TheDeepestCornerDragsTheMap)
{
  const DisparityMap map = SquareView(4);
  EXPECT_EQ(PointsBehindViolations(map, { 0, 1 }), (std::vector<char>{ 0, 0, 0, 1 }));
  EXPECT_EQ(PointsBehindViolations(map, { 0, 0 }), (std::vector<char>{ 0, 0, 0, 0 }));
  DisparityMap fan = map; // a second triangle at the deep corner, which is not violated
  AddFeature(fan, Pixel(800, 600), 2);
  fan.triangles.push_back({ 1, 4, 3 });
  EXPECT_EQ(PointsBehindViolations(fan, { 0, 1, 0 }), (std::vector<char>{ 0, 0, 0, 0, 0 }))
    << "half of those around it is not more than half";
  EXPECT_EQ(PointsBehindViolations(fan, { 0, 1, 1 }), (std::vector<char>{ 0, 0, 0, 1, 0 }));
}
