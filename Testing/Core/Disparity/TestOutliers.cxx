// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/Outliers/Outliers.h"

#include "Common/Error.h"
#include "Common/View.h"
#include "Disparity/Outliers/RadiusSupport.h"

#include <gtest/gtest.h>

#include <random>

using namespace freespace;

namespace
{

// Views of a wavy sheet. Its features come in different densities.
std::vector<View> SheetViews(int features)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<View> views(3);
  for (std::size_t v = 0; v < views.size(); ++v)
  {
    View& view = views[v];
    view.name = "cluster" + std::to_string(v);
    view.camera.K << 500, 0, 500, 0, 500, 500, 0, 0, 1;
    view.camera.width = view.camera.height = 1000;
    view.camera.R = Eigen::AngleAxisd(0.2 * (v - 1.0), Eigen::Vector3d::UnitY()).matrix();
    view.camera.t = { 0, 0, 3 };
    for (int i = 0; i < features; ++i)
    {
      const double x = unit(random), y = unit(random);
      view.points.emplace_back(x, y, 0.02 * std::cos(3 * x + y));
      view.imagePoints.push_back(view.camera.Project(view.points.back()));
    }
  }
  return views;
}

std::size_t CountAccepted(const std::vector<char>& accepted)
{
  return std::count(accepted.begin(), accepted.end(), 1);
}

}

TEST(RejectOutliers, WhatIsThrownAlongItsRayIsFoundAtAnyDensity)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> thrown(0.05, 0.15);
  for (const int features : { 200, 2000, 20000 })
  {
    std::vector<View> views = SheetViews(features);
    for (View& view : views)
    {
      for (std::size_t i = 0; i < view.points.size(); i += 20)
      {
        const Eigen::Vector3d center = view.camera.Center();
        view.points[i] =
          center + (i % 40 ? 1 - thrown(random) : 1 + thrown(random)) * (view.points[i] - center);
      }
    }
    const auto accepted = AcceptedFeatures(views, OutlierOptions());
    for (std::size_t v = 0; v < views.size(); ++v)
    {
      std::size_t kept = 0, missed = 0;
      for (std::size_t i = 0; i < accepted[v].size(); ++i)
      {
        missed += i % 20 == 0 && accepted[v][i];
        kept += i % 20 != 0 && accepted[v][i];
      }
      EXPECT_LE(missed, 0.1 * 0.05 * features) << "of " << features;
      EXPECT_GT(kept, 0.98 * 0.95 * features) << "of " << features;
    }
  }
}

TEST(RejectOutliers, WithoutTestsAllFeaturesInTrianglesPass)
{
  const std::vector<View> views = SheetViews(100);
  OutlierOptions options;
  options.support = 0;
  for (const auto& accepted : AcceptedFeatures(views, options))
  {
    EXPECT_EQ(CountAccepted(accepted), 100u);
  }
}

// Three outliers that support each other, in front of the sheet.
TEST(RejectOutliers, OtherViewsSeeThroughAClump)
{
  std::vector<View> views = SheetViews(2000);
  for (int i = 0; i < 3; ++i)
  {
    views[0].points[i] = views[0].camera.Unproject({ 500.0 + 0.3 * i, 500.0 + 0.1 * i * i }, 2);
  }
  OutlierOptions options;
  EXPECT_TRUE(AcceptedFeatures(views, options)[0][1]);
  options.seeThroughViews = 2;
  const auto accepted = AcceptedFeatures(views, options);
  EXPECT_FALSE(accepted[0][0] || accepted[0][1] || accepted[0][2]);
  EXPECT_GT(CountAccepted(accepted[1]), 1900u);
}

// A single outlier behind the sheet: the other views' features on the sheet lie in its free space.
TEST(RejectOutliers, FeaturesOfOtherViewsRefuteWhatIsBehindThem)
{
  std::vector<View> views = SheetViews(2000);
  const auto nearest = [&](const Eigen::Vector2d& pixel)
  {
    const auto& pixels = views[0].imagePoints;
    return std::min_element(pixels.begin(), pixels.end(),
             [&](const auto& a, const auto& b)
             { return (a - pixel).norm() < (b - pixel).norm(); }) -
      pixels.begin();
  };
  const std::size_t behind = nearest({ 500, 500 }), before = nearest({ 600, 500 });
  const Eigen::Vector3d center = views[0].camera.Center();
  views[0].points[behind] = center + 1.1 * (views[0].points[behind] - center);
  views[0].points[before] = center + 0.9 * (views[0].points[before] - center);
  OutlierOptions options;
  options.support = 0;
  options.violatingFeatures = 1;
  const auto accepted = AcceptedFeatures(views, options);
  EXPECT_FALSE(accepted[0][behind]);
  EXPECT_TRUE(accepted[0][before]); // it claims too little, not too much
  EXPECT_EQ(CountAccepted(accepted[0]), 1999u);
  EXPECT_EQ(CountAccepted(accepted[1]), 2000u);
  EXPECT_EQ(CountAccepted(accepted[2]), 2000u);
}

// The missed feature P of the paper's figure 4: one point in front violates the sheet's triangle, and
// it is the constraint's business, not an outlier of the sheet's.
TEST(RejectOutliers, AMissedFeatureRefutesNobody)
{
  std::vector<View> views = SheetViews(2000);
  views[1].points.push_back(views[1].camera.Unproject({ 500, 500 }, 2));
  views[1].imagePoints.emplace_back(500, 500);
  OutlierOptions options;
  options.support = 0;
  options.violatingFeatures = 1;
  const auto accepted = AcceptedFeatures(views, options);
  EXPECT_EQ(CountAccepted(accepted[0]), 2000u);
  EXPECT_EQ(CountAccepted(accepted[1]), 2001u);
}

// Isolated points: a radius of two mean distances has about twelve of them.
TEST(RejectOutliers, SupportWithinARadius)
{
  std::vector<View> views = SheetViews(2000);
  for (View& view : views)
  {
    for (std::size_t i = 0; i < view.points.size(); i += 20)
    {
      const Eigen::Vector3d center = view.camera.Center();
      view.points[i] = center + (i % 40 ? 1.2 : 0.8) * (view.points[i] - center);
    }
  }
  OutlierOptions options;
  options.radius = 2;
  options.tolerance = 0.01;
  const auto accepted = AcceptedFeatures(views, options);
  for (std::size_t v = 0; v < views.size(); ++v)
  {
    // The definition, by brute force.
    const double radius = 2 * MeanSpacing(views[v]);
    EXPECT_NEAR(radius, 2 * std::sqrt(1.0 / 2000) * 333, 4);
    for (std::size_t i = 0; i < views[v].points.size(); ++i)
    {
      int support = 0;
      for (std::size_t j = 0; j < views[v].points.size(); ++j)
      {
        const double a = 1 / views[v].camera.Depth(views[v].points[i]);
        const double b = 1 / views[v].camera.Depth(views[v].points[j]);
        support += i != j && (views[v].imagePoints[i] - views[v].imagePoints[j]).norm() <= radius &&
          std::abs(a - b) <= 0.01 * std::max(a, b);
      }
      EXPECT_EQ(accepted[v][i] != 0, support >= 2) << i;
    }
    EXPECT_GT(CountAccepted(accepted[v]), 1800u);
    EXPECT_LT(CountAccepted(accepted[v]), 1910u);
  }
  // What is left is then asked of the other views; their flags are those of all features.
  options.seeThroughViews = 2;
  const auto asked = AcceptedFeatures(views, options);
  for (std::size_t v = 0; v < views.size(); ++v)
  {
    ASSERT_EQ(asked[v].size(), 2000u);
    for (std::size_t i = 0; i < 2000; ++i)
    {
      EXPECT_LE(asked[v][i], accepted[v][i]);
    }
    EXPECT_GT(CountAccepted(asked[v]), 1700u);
  }
}

// A point far before a sheet has no support, unless three views have it.
TEST(RejectOutliers, WhatThreeViewsShareNeedsNoSupport)
{
  const Eigen::Vector3d alone(0.1, 0.2, -0.5);
  for (const double radius : { 0.0, 2.0 })
  {
    for (const std::size_t sharing : { 1, 2, 3 })
    {
      std::vector<View> views = SheetViews(500);
      for (std::size_t v = 0; v < sharing; ++v)
      {
        views[v].points.push_back(alone);
        views[v].imagePoints.push_back(views[v].camera.Project(alone));
      }
      // The same view twice is no second one.
      views[0].points.push_back(alone);
      views[0].imagePoints.push_back(views[0].camera.Project(alone));
      OutlierOptions options;
      options.radius = radius;
      EXPECT_EQ(AcceptedFeatures(views, options)[0][500], sharing == 3) << radius << " " << sharing;
      options.sharingViews = 2;
      EXPECT_EQ(AcceptedFeatures(views, options)[0][500], sharing >= 2) << radius << " " << sharing;
      options.sharingViews = 0;
      EXPECT_FALSE(AcceptedFeatures(views, options)[0][500]) << radius << " " << sharing;
    }
  }
}

TEST(RejectOutliers, ViewsKeepThreeFeatures)
{
  std::vector<View> views = SheetViews(3);
  EXPECT_EQ(RejectOutliers(views, OutlierOptions())[1].points.size(), 3u);
  EXPECT_TRUE(RejectOutliers({}, OutlierOptions()).empty());
}

TEST(RejectOutliers, OptionsOutOfRange)
{
  OutlierOptions options;
  options.noise = 0;
  EXPECT_THROW(RejectOutliers({}, options), Error);
  options = {};
  options.support = -1;
  EXPECT_THROW(RejectOutliers({}, options), Error);
  options = {};
  options.violatingFeatures = -1;
  EXPECT_THROW(RejectOutliers({}, options), Error);
  options = {};
  options.sharingViews = 1;
  EXPECT_THROW(RejectOutliers({}, options), Error);
  options = {};
  options.nearest = 0;
  EXPECT_THROW(RejectOutliers({}, options), Error);
  options = {};
  options.steepestAngle = 90;
  EXPECT_THROW(RejectOutliers({}, options), Error);
  options = {};
  options.radius = -1;
  EXPECT_THROW(RejectOutliers({}, options), Error);
  options.radius = 2;
  options.tolerance = NAN;
  EXPECT_THROW(RejectOutliers({}, options), Error);
  options = {};
  options.support = 7; // of the six nearest
  EXPECT_THROW(RejectOutliers({}, options), Error);
  options.radius = 2;
  EXPECT_NO_THROW(RejectOutliers({}, options));
}
