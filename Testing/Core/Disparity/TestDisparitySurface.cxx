// SPDX-License-Identifier: BSD-3-Clause
// The triangulated surface of one view, step by step. What it is as a whole: TestDelaunayDefinition,
// TestMinimumDisparity and TestSpatialFlips.
#include "Disparity/DisparitySurface.h"

#include "Common/Error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

using namespace freespace;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{

using Surface = DisparitySurface<PlainTriangulation>;

SightedPoint Point(double x, double y, double disparity)
{
  SightedPoint point;
  point.pixel = Pixel(x, y);
  point.disparity = disparity;
  point.point = Vector3d(x, y, 1) / disparity;
  return point;
}

// A square of disparity 1.
std::vector<SightedPoint> SquareMap()
{
  return { Point(0, 0, 1), Point(10, 0, 1), Point(10, 10, 1), Point(0, 10, 1) };
}

// Features of another view, kept alive with their sightings.
struct Others
{
  explicit Others(const std::vector<std::pair<Vector2d, double>>& places)
  {
    this->Features.reserve(places.size());
    for (const auto& [pixel, disparity] : places)
    {
      this->Features.push_back({ Vector3d(pixel.x(), pixel.y(), 1) / disparity, 1 });
      SightedFeature sighting;
      sighting.pixel = Pixel(pixel.x(), pixel.y());
      sighting.disparity = disparity;
      sighting.feature = &this->Features.back();
      this->Sightings.push_back(sighting);
    }
  }

  std::vector<FeatureCloud::Feature> Features;
  std::vector<SightedFeature> Sightings;
};

DisparityMap Inserted(const Others& others, double tolerance = 0)
{
  View view;
  view.name = "square";
  Surface surface(view);
  surface.TriangulateFeatures(SquareMap(), NeverCancelled);
  surface.AddCandidates(others.Sightings, NeverCancelled);
  surface.EnforceMinimumDisparity(tolerance, NeverCancelled);
  DisparityMap map;
  surface.Fill(map);
  return map;
}

double AreaOfMap(const DisparityMap& map)
{
  double sum = 0;
  for (const auto& [a, b, c] : map.triangles)
  {
    const Vector2d ab = map.imagePoints[b] - map.imagePoints[a];
    const Vector2d ac = map.imagePoints[c] - map.imagePoints[a];
    EXPECT_GT(ab.x() * ac.y() - ab.y() * ac.x(), 0);
    sum += (ab.x() * ac.y() - ab.y() * ac.x()) / 2;
  }
  return sum;
}

}

TEST(DisparitySurface, NearestOfFeaturesAtOnePixelIsTaken)
{
  std::vector<SightedPoint> features = SquareMap();
  features.push_back(Point(5, 5, 2));
  features.push_back(Point(5, 5, 4));
  features.push_back(Point(5, 5, 3));
  Surface surface{ View() };
  surface.TriangulateFeatures(features, NeverCancelled);
  DisparityMap map;
  surface.Fill(map);
  ASSERT_EQ(map.points.size(), 5u);
  EXPECT_EQ(map.points[4], features[5].point);
  EXPECT_EQ(map.triangles.size(), 4u);
  EXPECT_DOUBLE_EQ(AreaOfMap(map), 100);
}

TEST(DisparitySurface, NeedsThreeFeaturesThatAreNotCollinear)
{
  View view;
  view.name = "poor";
  const auto fault = [&view](const std::vector<SightedPoint>& features) -> std::string
  {
    try
    {
      Surface(view).TriangulateFeatures(features, NeverCancelled);
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(fault({}).find("'poor' has 0"), std::string::npos);
  EXPECT_NE(fault({ Point(0, 0, 1), Point(1, 1, 1) }).find("'poor' has 2"), std::string::npos);
  EXPECT_NE(
    fault({ Point(0, 0, 1), Point(1, 1, 1), Point(2, 2, 3) }).find("collinear"), std::string::npos);
  EXPECT_EQ(fault(SquareMap()), "");
}

TEST(DisparitySurface, OnlyWhatIsHigherByMoreThanTheToleranceIsInserted)
{
  const Others others(
    { { Vector2d(3, 4), 1.009 }, { Vector2d(7, 6), 1.011 }, { Vector2d(2, 8), 0.5 } });
  const DisparityMap map = Inserted(others, 0.01);
  ASSERT_EQ(map.points.size(), 5u);
  EXPECT_EQ(map.imagePoints[4], Vector2d(7, 6));
  EXPECT_EQ(map.sourceView, (std::vector<int>{ 0, 0, 0, 0, 1 }));
  EXPECT_DOUBLE_EQ(AreaOfMap(map), 100);
}

// The lower one would be above the square, but not above the surface that the higher one spans.
TEST(DisparitySurface, HighestIsInsertedFirst)
{
  const Others others({ { Vector2d(5, 4), 1.5 }, { Vector2d(5, 5), 3 } });
  const DisparityMap map = Inserted(others);
  ASSERT_EQ(map.points.size(), 5u);
  EXPECT_EQ(map.imagePoints[4], Vector2d(5, 5));
}

// Of equally high ones, the one that was given first.
TEST(DisparitySurface, OrderOfEqualCandidatesIsTheirOwn)
{
  const Others one({ { Vector2d(4, 5), 2 }, { Vector2d(6, 5), 2 } });
  const Others other({ { Vector2d(6, 5), 2 }, { Vector2d(4, 5), 2 } });
  EXPECT_EQ(Inserted(one).imagePoints[4], Vector2d(4, 5));
  EXPECT_EQ(Inserted(other).imagePoints[4], Vector2d(6, 5));
}

TEST(DisparitySurface, OutsideOfTheFeaturesNothingIsInserted)
{
  const Others others({ { Vector2d(-1, 5), 9 }, { Vector2d(11, 11), 9 } });
  EXPECT_EQ(Inserted(others).points.size(), 4u);
}

TEST(DisparitySurface, CandidateAtAFeatureReplacesIt)
{
  const Others others({ { Vector2d(10, 10), 5 } });
  const DisparityMap map = Inserted(others);
  ASSERT_EQ(map.points.size(), 4u);
  EXPECT_EQ(map.points[2], others.Features[0].point);
  EXPECT_EQ(map.sourceView[2], 1);
}

TEST(DisparitySurface, StopsWhenItIsCancelled)
{
  Surface surface{ View() };
  EXPECT_THROW(surface.TriangulateFeatures(SquareMap(), CancellationFlag(true)), Aborted);
}
