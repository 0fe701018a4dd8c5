// SPDX-License-Identifier: BSD-3-Clause
#include "Agreement/ProjectionErrors.h"

#include "Support/SyntheticModel.h"

#include <gtest/gtest.h>

using namespace freespace;

TEST(ProjectionErrors, ExactModelsHaveNone)
{
  EXPECT_TRUE(FindMisprojectedImages(MakeSyntheticModel(6, 100)).empty());
  EXPECT_TRUE(FindMisprojectedImages(MakeSyntheticModel(6, 100, LensModel::Radial)).empty());
  EXPECT_TRUE(FindMisprojectedImages(SparseModel()).empty());
}

TEST(ProjectionErrors, AMovedCameraIsToldWithItsPixels)
{
  SparseModel model = MakeSyntheticModel(6, 100);
  model.images[2].translation += Eigen::Vector3d(0.1, 0, 0);
  const auto wrong = FindMisprojectedImages(model);
  ASSERT_EQ(wrong.size(), 1u);
  EXPECT_EQ(wrong[0].name, "image2.jpg");
  EXPECT_NEAR(wrong[0].error, 700 * 0.1 / 2, 5); // f times the step over the depth
  EXPECT_EQ(NamesOf(wrong), (std::set<std::string>{ "image2.jpg" }));
  const std::string text = DescribeMisprojected({ { "a.jpg", 34.96 }, { "b.jpg", 120.4 } }, 7);
  EXPECT_EQ(text.rfind("2 of 7 images are left out", 0), 0u);
  EXPECT_NE(text.find(": a.jpg (35 pixels), b.jpg (120 pixels)"), std::string::npos);
}

TEST(ProjectionErrors, ASloppyModelIsNoWrongImage)
{
  SparseModel model = MakeSyntheticModel(6, 100);
  for (SparseImage& image : model.images)
  {
    for (SparseObservation& observation : image.observations)
    {
      observation.pixel += Eigen::Vector2d(6 + image.id % 3, 0);
    }
  }
  EXPECT_TRUE(FindMisprojectedImages(model).empty());
}

TEST(ProjectionErrors, AFewObservationsTellNothing)
{
  SparseModel model = MakeSyntheticModel(6, 100);
  model.images[2].translation += Eigen::Vector3d(0.1, 0, 0);
  model.images[2].observations.resize(9);
  EXPECT_TRUE(FindMisprojectedImages(model).empty());
}

TEST(ProjectionErrors, PointsBehindACameraAreWrong)
{
  SparseModel model = MakeSyntheticModel(6, 100);
  model.images[4].translation.z() = -2;
  const auto wrong = FindMisprojectedImages(model);
  ASSERT_EQ(wrong.size(), 1u);
  EXPECT_EQ(wrong[0].name, "image4.jpg");
}
