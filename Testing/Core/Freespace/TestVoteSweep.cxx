// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/Votes/VoteSweep.h"

#include "Support/RandomMaps.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

using namespace freespace;
using Eigen::Vector3d;

namespace
{

// A square around the origin of a camera that looks down on it, at a height of 1.
DisparityMap SquareAtOne()
{
  DisparityMap map;
  map.camera = LookingAt(Vector3d(0, 0, 10), Vector3d::Zero());
  for (const Eigen::Vector2d& pixel : { Eigen::Vector2d(40, 30), Eigen::Vector2d(60, 30),
         Eigen::Vector2d(60, 50), Eigen::Vector2d(40, 50) })
  {
    map.imagePoints.push_back(pixel);
    map.points.push_back(map.camera.Unproject(pixel, 9));
    map.sourceView.push_back(0);
  }
  map.triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  return map;
}

}

TEST(VoteSweep, OfNoViewIsTheCountOfTheOthers)
{
  VoteSweep sweep({ 2, 1 });
  EXPECT_EQ(sweep.Votes().free, 2);
  EXPECT_EQ(sweep.Votes().against, 1);
  EXPECT_FALSE(sweep.Next());
}

// Straight down through the square: free to its height, then against as far as the margin, then nothing.
TEST(VoteSweep, OfAViewAlongItsRay)
{
  const ViewFreespace view(SquareAtOne());
  const Vector3d first(0, 0, 2), last(0, 0, 0);
  VoteSweep sweep({ 0, 0 });
  sweep.Add(3, view, first, last, 0.05);
  ASSERT_TRUE(sweep.Next());
  EXPECT_EQ(sweep.Place(), 0);
  EXPECT_EQ(sweep.Votes().free, 1);
  EXPECT_EQ(sweep.Votes().against, 0);
  EXPECT_EQ(sweep.Opener(), 3);
  ASSERT_TRUE(sweep.Next());
  EXPECT_NEAR(sweep.Place(), 0.5, 1e-9);
  EXPECT_EQ(sweep.Votes().free, 0);
  EXPECT_EQ(sweep.Votes().against, 1);
  EXPECT_EQ(sweep.Opener(), -1);
  ASSERT_TRUE(sweep.Next());
  EXPECT_EQ(sweep.Votes().free, 0);
  EXPECT_EQ(sweep.Votes().against, 0);
  const double depth = 10 - 2 * (1 - sweep.Place());
  EXPECT_EQ(VoteOn(view, Vector3d(0, 0, 10 - depth + 1e-6), 0.05), Vote::Against);
  EXPECT_EQ(VoteOn(view, Vector3d(0, 0, 10 - depth - 1e-6), 0.05), Vote::None);
  EXPECT_FALSE(sweep.Next());
}

TEST(VoteSweep, WithoutAMarginNobodyIsAgainst)
{
  const ViewFreespace view(SquareAtOne());
  VoteSweep sweep({ 0, 0 });
  sweep.Add(0, view, Vector3d(0, 0, 2), Vector3d(0, 0, 0), 0);
  int changes = 0;
  while (sweep.Next())
  {
    ++changes;
    EXPECT_EQ(sweep.Votes().against, 0);
  }
  EXPECT_EQ(changes, 2);
}

// Between two changes all views vote as they do on a point there.
TEST(VoteSweep, AgreesWithTheVotesOnPoints)
{
  std::srand(1);
  int compared = 0, against = 0, free = 0;
  for (unsigned int seed = 0; seed < 30; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::vector<ViewFreespace> views;
    for (const DisparityMap& map : RandomMaps(seed, 1 + static_cast<int>(seed % 6)))
    {
      views.emplace_back(map);
    }
    const double margin = seed % 3 == 0 ? 0 : 0.02 * (seed % 5 + 1);
    for (int trial = 0; trial < 40; ++trial)
    {
      const Vector3d first = 2 * Vector3d::Random(), last = 2 * Vector3d::Random();
      VoteSweep sweep({ 0, 0 });
      for (std::size_t v = 0; v < views.size(); ++v)
      {
        sweep.Add(static_cast<int>(v), views[v], first, last, margin);
      }
      double from = 0;
      VoteCount votes = sweep.Votes();
      for (bool goesOn = true; goesOn;)
      {
        goesOn = sweep.Next();
        const double to = goesOn ? sweep.Place() : 1;
        ASSERT_GE(to, from);
        if (to - from > 1e-6)
        {
          const Vector3d middle = first + 0.5 * (from + to) * (last - first);
          VoteCount expected;
          for (const ViewFreespace& view : views)
          {
            expected.Add(VoteOn(view, middle, margin));
          }
          ASSERT_EQ(votes.free, expected.free) << from << " to " << to;
          ASSERT_EQ(votes.against, expected.against) << from << " to " << to;
          ++compared;
          against += votes.against > 0;
          free += votes.free > 0;
        }
        from = to;
        votes = sweep.Votes();
      }
    }
  }
  EXPECT_GT(compared, 3000);
  EXPECT_GT(against, 300);
  EXPECT_GT(free, 1000);
}
