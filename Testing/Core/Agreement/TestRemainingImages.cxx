// SPDX-License-Identifier: BSD-3-Clause
#include "Agreement/RemainingImages.h"

#include <gtest/gtest.h>

using namespace freespace;

namespace
{

Scene CrossScene()
{
  Scene scene;
  scene.clusters.push_back({ "cross", "c", { { "l", "c", "r" }, { "u", "c", "d" } } });
  scene.clusters.push_back({ "row", "x", { { "w", "x", "y" } } });
  return scene;
}

}

TEST(RemainingImages, NothingChangesWithoutANamedImage)
{
  const Scene scene = WithoutImages(CrossScene(), { "z" });
  ASSERT_EQ(scene.clusters.size(), 2u);
  EXPECT_EQ(scene.clusters[0].triplets, CrossScene().clusters[0].triplets);
}

TEST(RemainingImages, WhatIsLeftOfATripletFindsAPartner)
{
  const Scene scene = WithoutImages(CrossScene(), { "u" });
  ASSERT_EQ(scene.clusters.size(), 2u);
  const auto& triplets = scene.clusters[0].triplets;
  ASSERT_EQ(triplets.size(), 2u);
  EXPECT_EQ(triplets[0], (std::array<std::string, 3>{ "l", "c", "r" }));
  EXPECT_EQ(triplets[1], (std::array<std::string, 3>{ "d", "c", "l" }));
}

TEST(RemainingImages, AnotherImageTakesTheReferencesPlace)
{
  const Scene scene = WithoutImages(CrossScene(), { "c" });
  ASSERT_EQ(scene.clusters.size(), 2u);
  EXPECT_EQ(scene.clusters[0].name, "cross");
  EXPECT_EQ(scene.clusters[0].reference, "l");
  const auto& triplets = scene.clusters[0].triplets;
  ASSERT_EQ(triplets.size(), 2u);
  EXPECT_EQ(triplets[0], (std::array<std::string, 3>{ "r", "l", "u" }));
  EXPECT_EQ(triplets[1], (std::array<std::string, 3>{ "d", "l", "r" }));
}

TEST(RemainingImages, ClustersOfTwoAreGone)
{
  const Scene scene = WithoutImages(CrossScene(), { "w" });
  ASSERT_EQ(scene.clusters.size(), 1u);
  EXPECT_EQ(scene.clusters[0].name, "cross");
  EXPECT_TRUE(WithoutImages(CrossScene(), { "w", "l", "r", "c" }).clusters.empty());
}

TEST(RemainingImages, ModelLosesTheImagesAlone)
{
  SparseModel model;
  model.cameras.resize(1);
  model.images.resize(3);
  model.images[0].name = "a";
  model.images[1].name = "b";
  model.images[2].name = "c";
  const SparseModel left = WithoutImages(model, { "b" });
  ASSERT_EQ(left.images.size(), 2u);
  EXPECT_EQ(left.images[1].name, "c");
  EXPECT_EQ(left.cameras.size(), 1u);
}
