// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/ReferenceChoice.h"

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

// Cameras in the plane z = 0 that look along z onto a screen of points at depth 10, wide enough for all.
SparseModel LookingAtAScreen(const std::vector<Eigen::Vector2d>& places)
{
  SparseModel model = ParallelCameras(places, 500);
  for (double x = -2; x <= 2; x += 0.5)
  {
    for (double y = -2; y <= 2; y += 0.5)
    {
      SparsePoint point;
      point.id = model.points.size() + 1;
      point.position = { x, y, 10 };
      for (SparseImage& image : model.images)
      {
        image.observations.push_back({ { 0, 0 }, point.id });
      }
      model.points.push_back(point);
    }
  }
  return model;
}

double AngleOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  return std::atan2((a - b).norm(), 10) / degree;
}

std::vector<PossibleReference> AllPossible(std::size_t count, std::mt19937* random = nullptr)
{
  std::vector<PossibleReference> possible;
  for (std::size_t i = 0; i < count; ++i)
  {
    possible.push_back({ static_cast<int>(i), random ? 0.01 * ((*random)() % 100) : 1.0 });
  }
  return possible;
}

std::vector<Eigen::Vector2d> RandomPlaces(std::mt19937& random)
{
  std::uniform_real_distribution<double> place(-2.5, 2.5);
  std::vector<Eigen::Vector2d> places(150);
  for (Eigen::Vector2d& at : places)
  {
    at = { place(random), place(random) };
  }
  return places;
}

}

TEST(ReferenceChoice, WithoutASeparationAllAreTaken)
{
  const std::vector<Eigen::Vector2d> places(5, Eigen::Vector2d(0, 0));
  ClusterProposalOptions options;
  options.separation = 0;
  const ImageNeighborhoods images(LookingAtAScreen(places), options);
  EXPECT_EQ(ChooseReferences(images, AllPossible(5), options), (std::vector<int>{ 0, 1, 2, 3, 4 }));
  EXPECT_TRUE(ChooseReferences(images, {}, options).empty());
}

TEST(ReferenceChoice, OfTwoThatAreCloseTheBetterIsTaken)
{
  const std::vector<Eigen::Vector2d> places = { { 0, 0 }, { 0.1, 0 }, { 2, 0 } };
  const ClusterProposalOptions options;
  const ImageNeighborhoods images(LookingAtAScreen(places), options);
  EXPECT_EQ(ChooseReferences(images, { { 0, 0.5 }, { 1, 0.6 }, { 2, 0.1 } }, options),
    (std::vector<int>{ 1, 2 }));
  EXPECT_EQ(ChooseReferences(images, { { 0, 0.6 }, { 1, 0.6 }, { 2, 0.1 } }, options),
    (std::vector<int>{ 0, 2 }))
    << "of equals the first";
  EXPECT_EQ(ChooseReferences(images, { { 1, 0.2 } }, options), (std::vector<int>{ 1 }))
    << "of those that can be";
}

// With no limit of the coverage: no two are closer than the separation, and none could be added.
TEST(ReferenceChoice, KeepsItsDistanceAndLeavesNoGap)
{
  std::mt19937 random(5);
  const std::vector<Eigen::Vector2d> places = RandomPlaces(random);
  ClusterProposalOptions options;
  options.coverage = 0;
  const ImageNeighborhoods images(LookingAtAScreen(places), options);
  const std::vector<int> chosen =
    ChooseReferences(images, AllPossible(places.size(), &random), options);
  EXPECT_TRUE(std::is_sorted(chosen.begin(), chosen.end()));
  EXPECT_GT(chosen.size(), 10u);
  EXPECT_LT(chosen.size(), 80u);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    double nearest = HUGE_VAL;
    for (const int other : chosen)
    {
      if (other != static_cast<int>(i))
      {
        nearest = std::min(nearest, AngleOf(places[i], places[other]));
      }
    }
    const bool isChosen = std::binary_search(chosen.begin(), chosen.end(), static_cast<int>(i));
    if (isChosen)
    {
      EXPECT_GE(nearest, options.separation - 1e-6) << i;
    }
    else
    {
      EXPECT_LT(nearest, options.separation + 1e-6) << i;
    }
  }
}

// Enough references within the coverage angle make an image superfluous, however far it is from each.
TEST(ReferenceChoice, WhatIsCoveredOftenEnoughIsLeftOut)
{
  std::mt19937 random(6);
  const std::vector<Eigen::Vector2d> places = RandomPlaces(random);
  ClusterProposalOptions options;
  const ImageNeighborhoods images(LookingAtAScreen(places), options);
  const std::vector<PossibleReference> possible = AllPossible(places.size(), &random);
  const std::vector<int> limited = ChooseReferences(images, possible, options);
  options.coverage = 0;
  const std::vector<int> unlimited = ChooseReferences(images, possible, options);
  EXPECT_LT(limited.size(), unlimited.size());
  options.coverage = 3;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    if (std::binary_search(limited.begin(), limited.end(), static_cast<int>(i)))
    {
      continue;
    }
    int near = 0;
    double nearest = HUGE_VAL;
    for (const int other : limited)
    {
      near += AngleOf(places[i], places[other]) <= options.coverageAngle + 1e-6;
      nearest = std::min(nearest, AngleOf(places[i], places[other]));
    }
    EXPECT_TRUE(near >= options.coverage || nearest < options.separation) << i;
  }
}
