// SPDX-License-Identifier: BSD-3-Clause
#include "Agreement/ImageAgreement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace freespace;

namespace
{

// Images in a row, each matched with the two on either side. Every image belongs to a world; images of one
// world confirm each other, others show tokens by chance.
std::vector<ImageAgreement> RowOfImages(const std::vector<int>& worlds, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> good(0.7, 1.0), chance(0.0, 0.35);
  const int count = static_cast<int>(worlds.size());
  std::vector<ImageAgreement> agreements;
  for (int i = 0; i < count; ++i)
  {
    ImageAgreement agreement;
    agreement.image = i;
    agreement.tokens = 1000;
    int same = 0;
    for (int j = std::max(0, i - 2); j <= std::min(count - 1, i + 2); ++j)
    {
      same += j != i && worlds[j] == worlds[i];
    }
    agreement.confirmed = same >= 2 ? 150 * good(random) : 3 * good(random);
    for (int j = std::max(0, i - 2); j <= std::min(count - 1, i + 2); ++j)
    {
      if (j != i)
      {
        const double shown = worlds[j] == worlds[i] ? good(random) : chance(random);
        agreement.others.emplace_back(j, shown * agreement.confirmed);
      }
    }
    agreements.push_back(agreement);
  }
  return agreements;
}

}

TEST(ImageAgreement, NobodyContradictsWhereAllAgree)
{
  for (unsigned int seed = 0; seed < 20; ++seed)
  {
    const Agreement found = FindAgreement(12, RowOfImages(std::vector<int>(12, 0), seed));
    EXPECT_EQ(found.confirmed.size(), 12u);
    EXPECT_TRUE(found.contradicted.empty());
  }
}

TEST(ImageAgreement, SingleWrongImagesAreFound)
{
  for (unsigned int seed = 0; seed < 20; ++seed)
  {
    const Agreement found =
      FindAgreement(12, RowOfImages({ 0, 0, 1, 0, 0, 0, 0, 2, 0, 0, 0, 0 }, seed));
    EXPECT_EQ(found.contradicted, (std::vector<int>{ 2, 7 }));
  }
}

TEST(ImageAgreement, OfTwoWorldsTheLargerIsRight)
{
  const Agreement found = FindAgreement(12, RowOfImages({ 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1 }, 1));
  EXPECT_EQ(found.contradicted, (std::vector<int>{ 8, 9, 10, 11 }));
}

TEST(ImageAgreement, GroupsThatWereNeverComparedAreLeftInPeace)
{
  std::vector<ImageAgreement> two = RowOfImages(std::vector<int>(5, 0), 1);
  for (ImageAgreement agreement : RowOfImages(std::vector<int>(4, 0), 2))
  {
    agreement.image += 5;
    for (auto& other : agreement.others)
    {
      other.first += 5;
    }
    two.push_back(agreement);
  }
  const Agreement found = FindAgreement(9, two);
  EXPECT_EQ(found.confirmed.size(), 9u);
  EXPECT_TRUE(found.contradicted.empty());
}

TEST(ImageAgreement, NothingIsKnownWithoutMatches)
{
  EXPECT_EQ(FindAgreement(3, {}).unknown.size(), 3u);
  EXPECT_TRUE(FindAgreement(0, {}).unknown.empty());
  ImageAgreement nothing;
  nothing.others = { { 1, 0 }, { 2, 0 } };
  EXPECT_EQ(FindAgreement(3, { nothing }).unknown.size(), 3u);
}

// A right image between wrong ones alone has nothing confirmed, and that is no evidence against it.
TEST(ImageAgreement, WrongNeighborsAreNoEvidence)
{
  std::vector<ImageAgreement> row = RowOfImages(std::vector<int>(8, 0), 3);
  row[3].confirmed = 1;
  row[3].others = { { 6, 0 }, { 7, 0 } }; // which are not compared with each other
  row[6].others = { { 4, row[6].confirmed }, { 5, row[6].confirmed } };
  row[7].others = { { 4, row[7].confirmed }, { 5, row[7].confirmed } };
  const Agreement found = FindAgreement(8, row);
  EXPECT_TRUE(std::binary_search(found.confirmed.begin(), found.confirmed.end(), 3));
}
