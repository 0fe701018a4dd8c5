// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/ImageNeighborhoods.h"

#include "Support/Core/ParallelCameras.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

// At depth d they see a square of side 0.8 d.
SparseModel CamerasAt(const std::vector<Eigen::Vector2d>& places)
{
  return ParallelCameras(places, 1000);
}

// Points of a dense grid at depth 10, observed by each image that sees them.
SparseModel WithScreen(SparseModel model, double depth = 10)
{
  for (double x = -12; x <= 12; x += 0.25)
  {
    for (double y = -8; y <= 8; y += 0.25)
    {
      SparsePoint point;
      point.id = model.points.size() + 1;
      point.position = { x, y, depth };
      for (SparseImage& image : model.images)
      {
        const Vector3d seen = point.position + image.translation;
        const Eigen::Vector2d pixel = 1000 * seen.head<2>() / seen.z() + Eigen::Vector2d(400, 400);
        if (pixel.minCoeff() >= 0 && pixel.maxCoeff() <= 800)
        {
          image.observations.push_back({ pixel, point.id });
        }
      }
      model.points.push_back(point);
    }
  }
  return model;
}

}

TEST(ImageNeighborhoods, DepthIsThatOfThePoints)
{
  const ImageNeighborhoods images(
    WithScreen(CamerasAt({ { 0, 0 }, { 1, 0 } }), 7), ClusterProposalOptions());
  EXPECT_EQ(images.Size(), 2u);
  EXPECT_NEAR(images.Depth(0), 7, 1e-9);
  EXPECT_NEAR(images.Depth(1), 7, 1e-9);
}

// Without points and with parallel axes, the nearest neighbour is taken to be at the preferred angle.
TEST(ImageNeighborhoods, DepthWithoutPointsIsThatOfThePreferredAngle)
{
  ClusterProposalOptions options;
  options.preferredAngle = 10;
  const ImageNeighborhoods images(CamerasAt({ { 0, 0 }, { 2, 0 }, { 5, 0 } }), options);
  EXPECT_NEAR(images.Depth(0), 2 / std::tan(10 * M_PI / 180), 1e-9);
  EXPECT_NEAR(images.Depth(2), 3 / std::tan(10 * M_PI / 180), 1e-9);
}

// Axes that cross: at the depth where they do.
TEST(ImageNeighborhoods, DepthWithoutPointsIsWhereTheAxesCross)
{
  SparseModel model = CamerasAt({ { 0, 0 }, { 0, 0 } });
  const Eigen::Matrix3d turned =
    Eigen::AngleAxisd(0.3, Vector3d::UnitY()).toRotationMatrix(); // about (0, 0, 4)
  const Eigen::Quaterniond q(turned);
  model.images[1].rotation = { q.w(), q.x(), q.y(), q.z() };
  model.images[1].translation = Vector3d(0, 0, 4) - turned * Vector3d(0, 0, 4);
  const ImageNeighborhoods images(model, ClusterProposalOptions());
  EXPECT_NEAR(images.Depth(0), 4, 1e-9);
  EXPECT_NEAR(images.Depth(1), 4, 1e-9);
}

// Of a screen at depth 10 each sees 8 x 8, shifted by the baseline.
TEST(ImageNeighborhoods, OverlapIsThatOfTheSquaresOnTheScreen)
{
  const ImageNeighborhoods images(
    WithScreen(CamerasAt({ { 0, 0 }, { 2, 0 }, { 2, 2 }, { -9, 0 } })), ClusterProposalOptions());
  EXPECT_EQ(images.Overlap(0, 0), 1);
  EXPECT_NEAR(images.Overlap(0, 1), 0.75, 0.06) << "300 points of all";
  EXPECT_NEAR(images.Overlap(0, 2), 0.75 * 0.75, 0.06);
  EXPECT_EQ(images.Overlap(0, 3), 0);
}

TEST(ImageNeighborhoods, WhatHasNoPointInCommonDoesNotOverlap)
{
  SparseModel model = WithScreen(CamerasAt({ { 0, 0 }, { 0.5, 0 } }));
  for (SparseObservation& observation : model.images[1].observations)
  {
    observation.point = SparseObservation::noPoint; // something occludes them
  }
  const ImageNeighborhoods images(model, ClusterProposalOptions());
  EXPECT_EQ(images.Overlap(0, 1), 0);
}

TEST(ImageNeighborhoods, AnglesAreSeenFromTheScene)
{
  const ImageNeighborhoods images(
    WithScreen(CamerasAt({ { 0, 0 }, { 1, 0 }, { 0, -3 } })), ClusterProposalOptions());
  EXPECT_NEAR(images.AngleBetween(0, 1), std::atan2(1, 10), 1e-3);
  EXPECT_NEAR(images.AngleBetween(0, 2), std::atan2(3, 10), 1e-3);
  EXPECT_EQ(images.AngleBetween(0, 0), 0);
}

TEST(ImageNeighborhoods, WithinAnAngleAgreesWithBruteForce)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-3, 3);
  std::vector<Eigen::Vector2d> places(60);
  for (Eigen::Vector2d& at : places)
  {
    at = { place(random), place(random) };
  }
  const ImageNeighborhoods images(WithScreen(CamerasAt(places)), ClusterProposalOptions());
  for (std::size_t i = 0; i < places.size(); i += 7)
  {
    for (const double angle : { 2.0, 6.0, 15.0 })
    {
      std::vector<int> found = images.Within(i, angle * degree), expected;
      std::sort(found.begin(), found.end());
      for (std::size_t j = 0; j < places.size(); ++j)
      {
        if ((places[i] - places[j]).norm() <= images.Depth(i) * std::tan(angle * degree))
        {
          expected.push_back(static_cast<int>(j));
        }
      }
      EXPECT_EQ(found, expected);
    }
  }
}

TEST(ImageNeighborhoods, NeighboursAreWithinTheAnglesAndTheBestFirst)
{
  // At 0.5, 3, 5, 10, 22 and 35 degrees of the first one's scene.
  std::vector<Eigen::Vector2d> places = { { 0, 0 } };
  for (const double angle : { 0.5, 3.0, 5.0, 10.0, 22.0, 35.0 })
  {
    places.emplace_back(10 * std::tan(angle * degree), 0);
  }
  const ImageNeighborhoods images(WithScreen(CamerasAt(places)), ClusterProposalOptions());
  const std::vector<Neighbor> neighbors = images.NeighborsOf(0);
  std::vector<int> order;
  for (const Neighbor& neighbor : neighbors)
  {
    order.push_back(neighbor.image);
    EXPECT_NEAR(neighbor.distance, places[neighbor.image].x(), 1e-9);
    EXPECT_LT((neighbor.direction - Eigen::Vector2d(1, 0)).norm(), 1e-9);
    EXPECT_GT(neighbor.quality, 0);
    EXPECT_LE(neighbor.quality, 1);
    EXPECT_GE(neighbor.overlap, 0.4);
  }
  // 0.5 is below the least angle; at 35 degrees, and above the greatest, less than 0.4 overlaps.
  EXPECT_EQ(order, (std::vector<int>{ 3, 2, 4, 5 }));
}

TEST(ImageNeighborhoods, ANeighbourStraightAheadIsNone)
{
  SparseModel model = CamerasAt({ { 0, 0 }, { 0, 0 } });
  model.images[1].translation = { -0.1, 0, -2 }; // its epipole is in the image
  EXPECT_TRUE(
    ImageNeighborhoods(WithScreen(model), ClusterProposalOptions()).NeighborsOf(0).empty());
}
