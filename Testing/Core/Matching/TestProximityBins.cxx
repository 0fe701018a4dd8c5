// SPDX-License-Identifier: BSD-3-Clause
// The filter against all pairs of places.
#include "Matching/ProximityBins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace freespace;

namespace
{

struct Place
{
  int image;
  float center, reach;
};

bool Meet(const Place& a, const Place& b, float more = 0)
{
  return a.image != b.image && std::abs(a.center - b.center) <= std::max(a.reach, b.reach) + more;
}

}

TEST(ProximityBins, NoMeetingIsMissed)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<float> center(-400, 400), reach(0, 3), far(0, 100);
  std::uniform_int_distribution<int> image(0, 3);
  int meeting = 0, apart = 0, kept = 0;
  for (int trial = 0; trial < 200; ++trial)
  {
    ProximityBins bins(4);
    std::vector<Place> places;
    for (int i = 0; i < 20; ++i)
    {
      // One place in each trial reaches over several words of 64 bins.
      places.push_back({ image(random), center(random), i == 0 ? far(random) : reach(random) });
      bins.Add(places.back().image, places.back().center, places.back().reach);
    }
    bins.Finish();
    for (const Place& place : places)
    {
      const auto meets = [&](float more)
      {
        return std::any_of(places.begin(), places.end(),
          [&](const Place& other) { return Meet(place, other, more); });
      };
      const bool passes = bins.Meets(place.image, place.center, place.reach);
      if (meets(0))
      {
        ASSERT_TRUE(passes) << trial << ": " << place.center << " +- " << place.reach;
        ++meeting;
      }
      else if (!meets(1)) // bins are one wide: 1024 of them hold all places, so none share one
      {
        ++apart;
        kept += passes;
      }
    }
  }
  EXPECT_GT(meeting, 500);
  EXPECT_GT(apart, 500);
  EXPECT_EQ(kept, 0) << "what is more than a bin away is filtered out";
}

TEST(ProximityBins, PlacesOfOneImageDoNotMeet)
{
  ProximityBins bins(2);
  bins.Add(0, 5.5F, 1);
  bins.Add(0, 5.6F, 1);
  bins.Finish();
  EXPECT_FALSE(bins.Meets(0, 5.5F, 1));
  EXPECT_TRUE(bins.Meets(1, 5.5F, 1));
}

TEST(ProximityBins, ClearedBinsAreEmpty)
{
  ProximityBins bins(2);
  bins.Add(0, 5, 1);
  bins.Clear();
  bins.Finish();
  EXPECT_FALSE(bins.Meets(1, 5, 1));
}

// Places of several images, some far along a line, held against looking at every pair.
TEST(ProximityBins, MissNoPlaceThatMeetsAnother)
{
  std::mt19937 engine(11);
  const auto uniform = [&](double low, double high)
  { return std::uniform_real_distribution<double>(low, high)(engine); };
  int met = 0, alone = 0, wrong = 0;
  for (int trial = 0; trial < 300; ++trial)
  {
    struct Place
    {
      int image;
      float center, reach;
    };
    std::vector<Place> places;
    ProximityBins bins(3);
    bins.Clear();
    for (int k = 0; k < 40; ++k)
    {
      places.push_back({ k % 3, static_cast<float>(uniform(-900, 900)),
        static_cast<float>(k % 7 == 0 ? uniform(0, 150) : uniform(0, 3)) });
      bins.Add(places.back().image, places.back().center, places.back().reach);
    }
    bins.Finish();
    for (const Place& a : places)
    {
      const bool expected = std::any_of(places.begin(), places.end(),
        [&](const Place& b) {
          return b.image != a.image && std::abs(a.center - b.center) <= std::max(a.reach, b.reach);
        });
      const bool found = bins.Meets(a.image, a.center, a.reach);
      EXPECT_TRUE(found || !expected) << trial << " " << a.center << " " << a.reach;
      met += expected;
      alone += !expected;
      wrong += found && !expected;
    }
  }
  EXPECT_GT(met, 1000);
  EXPECT_LT(wrong, alone / 2); // or it would save nothing
}
