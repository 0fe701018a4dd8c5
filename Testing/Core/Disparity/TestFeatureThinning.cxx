// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/FeatureThinning.h"

#include "Common/Error.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <limits>
#include <random>
#include <set>

using namespace freespace;

namespace
{

View EmptyView()
{
  View view;
  view.name = "cluster";
  view.imageFile = "image.png";
  view.camera.K << 800, 0, 320, 0, 800, 240, 0, 0, 1;
  view.camera.width = 640;
  view.camera.height = 480;
  view.camera.R = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  view.camera.t = { 0.1, -0.2, 0.3 };
  return view;
}

void AddFeatureAt(View& view, const Eigen::Vector2d& pixel, double disparity, double deviation = -1)
{
  view.imagePoints.push_back(pixel);
  view.points.push_back(view.camera.Unproject(pixel, 1 / disparity));
  if (deviation >= 0)
  {
    view.deviations.push_back(deviation);
  }
}

double DisparityOf(const View& view, std::size_t feature)
{
  return 1 / view.camera.Depth(view.points[feature]);
}

FeatureThinningOptions WithSpacing(double spacing)
{
  FeatureThinningOptions options;
  options.spacing = spacing;
  return options;
}

}

TEST(FeatureThinning, MeanWeightedByTheInverseVariances)
{
  View view = EmptyView();
  AddFeatureAt(view, { 30.5, 30.5 }, 1.000, 0.001);
  AddFeatureAt(view, { 32.5, 31.5 }, 1.003, 0.002); // a quarter of the weight
  const View thin = ThinFeatures(view, WithSpacing(3));
  ASSERT_EQ(thin.points.size(), 1u);
  EXPECT_NEAR(DisparityOf(thin, 0), 1.0006, 1e-12);
  EXPECT_NEAR((thin.imagePoints[0] - Eigen::Vector2d(30.9, 30.7)).norm(), 0, 1e-12);
  EXPECT_NEAR((thin.camera.Project(thin.points[0]) - thin.imagePoints[0]).norm(), 0, 1e-9);
  EXPECT_NEAR(thin.deviations[0], std::sqrt(2 / (1e6 + 0.25e6)), 1e-12);
  EXPECT_EQ(thin.name, view.name);
  EXPECT_EQ(thin.imageFile, view.imageFile);
}

TEST(FeatureThinning, OneAloneKeepsItsPlaceBesideItsProjection)
{
  View view = EmptyView();
  AddFeatureAt(view, { 100, 100 }, 0.5);
  view.imagePoints[0] +=
    Eigen::Vector2d(0.4, -0.3); // the observation of a point that others see, too
  const View thin = ThinFeatures(view, WithSpacing(3));
  EXPECT_EQ(thin.points, view.points);
  EXPECT_EQ(thin.imagePoints, view.imagePoints);
}

TEST(FeatureThinning, UnknownDeviationsCountLikeTheTypicalOne)
{
  View view = EmptyView();
  AddFeatureAt(view, { 30.5, 30.5 }, 1.000, 0.001);
  AddFeatureAt(view, { 31.5, 30.5 }, 1.002, 0);
  const View thin = ThinFeatures(view, WithSpacing(3));
  ASSERT_EQ(thin.points.size(), 1u);
  EXPECT_NEAR(DisparityOf(thin, 0), 1.001, 1e-12);
  EXPECT_NEAR(thin.deviations[0], 0.001, 1e-12);
}

TEST(FeatureThinning, DepthsOfAnOcclusionStayApart)
{
  View view = EmptyView();
  AddFeatureAt(view, { 30.5, 30.5 }, 1.0);
  AddFeatureAt(view, { 31.5, 30.5 }, 0.5);
  AddFeatureAt(view, { 32.5, 30.5 }, 1.001);
  const View thin = ThinFeatures(view, WithSpacing(3));
  ASSERT_EQ(thin.points.size(), 2u);
  EXPECT_NEAR(DisparityOf(thin, 0), 1.0005, 1e-12);
  EXPECT_NEAR(DisparityOf(thin, 1), 0.5, 1e-12);
  EXPECT_TRUE(thin.deviations.empty());
}

TEST(FeatureThinning, EdgesJoinTheMergedFeatures)
{
  View view = EmptyView();
  for (int i = 0; i < 6; ++i)
  {
    AddFeatureAt(view, { 30.5 + i, 30.5 }, 1);
  }
  view.edges = { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 4 }, { 5, 4 }, { 3, 2 } };
  const View thin = ThinFeatures(view, WithSpacing(3));
  ASSERT_EQ(thin.points.size(), 2u);
  EXPECT_EQ(thin.edges, (std::vector<std::array<int, 2>>{ { 0, 1 } }));
}

TEST(FeatureThinning, NothingIsMergedWithoutASpacing)
{
  View view = EmptyView();
  AddFeatureAt(view, { 30.5, 30.5 }, 1);
  AddFeatureAt(view, { 30.5, 30.5 }, 1);
  const View thin = ThinFeatures(view, WithSpacing(0));
  EXPECT_EQ(thin.points, view.points);
  EXPECT_EQ(thin.imagePoints, view.imagePoints);
}

TEST(FeatureThinning, UselessFeaturesAreLeftOut)
{
  View view = EmptyView();
  AddFeatureAt(view, { 30.5, 30.5 }, -1);
  AddFeatureAt(view, { 40.5, 30.5 }, 1);
  AddFeatureAt(view, { 50.5, 30.5 }, 1);
  AddFeatureAt(view, { 60.5, 30.5 }, 1);
  view.points[1].x() = std::numeric_limits<double>::quiet_NaN();
  view.imagePoints[2].y() = std::numeric_limits<double>::infinity();
  const View thin = ThinFeatures(view, WithSpacing(3));
  ASSERT_EQ(thin.points.size(), 1u);
  EXPECT_EQ(thin.imagePoints[0].x(), 60.5);
  EXPECT_TRUE(ThinFeatures(EmptyView(), WithSpacing(3)).points.empty());
}

// Disparity is affine over the image of a plane, and so is a mean: merged features stay on it.
TEST(FeatureThinning, APlaneStaysAPlane)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(0, 640), y(0, 480), deviation(0.001, 0.01);
  View view = EmptyView();
  const auto disparity = [](const Eigen::Vector2d& pixel)
  { return 1 + 1e-4 * pixel.x() - 2e-4 * pixel.y(); };
  for (int i = 0; i < 20000; ++i)
  {
    const Eigen::Vector2d pixel(x(random), y(random));
    AddFeatureAt(view, pixel, disparity(pixel), deviation(random));
  }
  const View thin = ThinFeatures(view, WithSpacing(4));
  EXPECT_LE(thin.points.size(), 160u * 120u);
  EXPECT_GT(thin.points.size(), 10000u);
  std::set<std::pair<int, int>> cells;
  for (std::size_t i = 0; i < thin.points.size(); ++i)
  {
    const Eigen::Vector2d& pixel = thin.imagePoints[i];
    EXPECT_NEAR(DisparityOf(thin, i), disparity(pixel), 1e-9);
    cells.emplace(static_cast<int>(pixel.x() / 4), static_cast<int>(pixel.y() / 4));
  }
  EXPECT_EQ(cells.size(), thin.points.size()); // one a cell: the plane is flat enough
}

TEST(FeatureThinning, RefusesOptionsOutOfRange)
{
  FeatureThinningOptions options;
  options.spacing = -1;
  EXPECT_THROW(options.Check(), Error);
  options = {};
  options.depthTolerance = 0;
  EXPECT_THROW(options.Check(), Error);
}
