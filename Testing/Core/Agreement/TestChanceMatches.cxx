// SPDX-License-Identifier: BSD-3-Clause
#include "Agreement/ChanceMatches.h"

#include "Common/Error.h"

#include <gtest/gtest.h>

#include <vector>

using namespace freespace;

namespace
{

std::vector<CalibratedImage> ThreeImages()
{
  std::vector<CalibratedImage> images(3);
  for (int i = 0; i < 3; ++i)
  {
    images[i].camera.t = Eigen::Vector3d(0.1 * i, 0.2, 2);
  }
  return images;
}

ImageAgreement Confirmed(double tokens)
{
  ImageAgreement agreement;
  agreement.image = 1;
  agreement.tokens = 10000;
  agreement.confirmed = tokens;
  return agreement;
}

bool Exceeds(double confirmed, const std::vector<double>& byChance)
{
  std::size_t call = 0;
  const bool exceeds = ExceedsChance(ThreeImages(), Cluster(), Confirmed(confirmed),
    [&](const std::vector<CalibratedImage>&, const Cluster&)
    { return Confirmed(byChance.at(call++)); });
  EXPECT_EQ(call, byChance.size());
  return exceeds;
}

}

TEST(ChanceMatches, TheMostOfTheTurnedCamerasCounts)
{
  EXPECT_TRUE(Exceeds(90, { 0, 0, 0 }));
  EXPECT_FALSE(Exceeds(20, { 0, 0, 0 })) << "too few to tell";
  EXPECT_TRUE(Exceeds(600, { 10, 100, 20 }));
  EXPECT_FALSE(Exceeds(500, { 10, 100, 20 }));
  EXPECT_FALSE(Exceeds(100, { 300, 0, 0 })) << "it is upside down";
}

TEST(ChanceMatches, OnlyTheImagesOwnCameraTurnsAboutItsCentre)
{
  const std::vector<CalibratedImage> images = ThreeImages();
  int calls = 0;
  ExceedsChance(images, Cluster(), Confirmed(90),
    [&](const std::vector<CalibratedImage>& turned, const Cluster&)
    {
      ++calls;
      for (std::size_t i = 0; i < images.size(); ++i)
      {
        EXPECT_LT((turned[i].camera.Center() - images[i].camera.Center()).norm(), 1e-12);
        EXPECT_NEAR(turned[i].camera.R.determinant(), 1, 1e-12);
        EXPECT_EQ(turned[i].camera.R != images[i].camera.R, i == 1);
      }
      return ImageAgreement();
    });
  EXPECT_EQ(calls, 3);
}

TEST(ChanceMatches, ACameraThatSeesNothingIsNoChance)
{
  EXPECT_TRUE(ExceedsChance(ThreeImages(), Cluster(), Confirmed(90),
    [](const std::vector<CalibratedImage>&, const Cluster&) -> ImageAgreement
    { throw Error("A triplet has no overlap."); }));
}

// 3, 4, 5 see each other; 8 sees 4 and 5, which do not show its tokens; 9 sees only images that do not count.
TEST(ChanceMatches, GroupsOfThreeConfirmEachOther)
{
  std::vector<ImageAgreement> agreements(5);
  const int images[] = { 5, 3, 4, 8, 9 };
  for (int i = 0; i < 5; ++i)
  {
    agreements[i].image = images[i];
  }
  agreements[0].others = { { 3, 20 }, { 4, 30 }, { 1, 2 } };
  agreements[1].others = { { 4, 20 }, { 5, 30 } };
  agreements[2].others = { { 3, 20 }, { 5, 30 } };
  agreements[3].others = { { 4, 0 }, { 5, 40 } };
  agreements[4].others = { { 0, 50 }, { 1, 40 } };
  EXPECT_EQ(ConfirmedByEachOther(agreements), (std::vector<int>{ 3, 4, 5 }));
  agreements.resize(2);
  EXPECT_TRUE(ConfirmedByEachOther(agreements).empty()) << "two are no group";
  EXPECT_TRUE(ConfirmedByEachOther({}).empty());
}
