// SPDX-License-Identifier: BSD-3-Clause
// The union where views contradict each other, against counting the votes of all views.
#include "Freespace/Votes/ViewVotes.h"

#include "Freespace/FreespaceQueries.h"
#include "Freespace/FreespaceUnion.h"
#include "Support/RandomMaps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

using namespace freespace;
using Eigen::AlignedBox3d;
using Eigen::Vector3d;

namespace
{

FreespaceUnion MakeVotingUnion(unsigned int seed)
{
  FreespaceUnionOptions options;
  options.hullMargin = 0.01;
  options.contradiction = 0.1 + 0.3 * (seed % 4);
  options.surroundings = seed % 3 == 0 ? 0.5 : 0;
  return FreespaceUnion(RandomMaps(seed, 1 + static_cast<int>(seed % 7)), options);
}

VoteCount CountVotes(const FreespaceUnion& phi, const Vector3d& point)
{
  VoteCount votes;
  for (std::size_t v = 0; v < phi.NumberOfViews(); ++v)
  {
    votes.Add(VoteOn(phi.ViewAt(v), point, phi.MarginOf(static_cast<int>(v))));
  }
  return votes;
}

// A view from far above on the square around the origin, which it sees at a height.
DisparityMap SquareAt(double height)
{
  DisparityMap map;
  map.camera = LookingAt(Vector3d(0, 0, 10), Vector3d::Zero());
  for (const Eigen::Vector2d& pixel : { Eigen::Vector2d(40, 30), Eigen::Vector2d(60, 30),
         Eigen::Vector2d(60, 50), Eigen::Vector2d(40, 50) })
  {
    map.imagePoints.push_back(pixel);
    map.points.push_back(map.camera.Unproject(pixel, 10 - height));
    map.sourceView.push_back(0);
  }
  map.triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  return map;
}

FreespaceUnion Squares(const std::vector<double>& heights)
{
  std::vector<DisparityMap> maps;
  for (const double height : heights)
  {
    maps.push_back(SquareAt(height));
  }
  FreespaceUnionOptions options;
  options.hullMargin = 0.2;
  options.surroundings = 0;
  return FreespaceUnion(maps, options);
}

}

TEST(ViewVotes, OfAPointCloselyBehindASurface)
{
  const ViewFreespace view(SquareAt(1)); // at a depth of 9
  EXPECT_EQ(VoteOn(view, Vector3d(0, 0, 1.01), 0.1), Vote::Free);
  EXPECT_EQ(VoteOn(view, Vector3d(0, 0, 0.99), 0.1), Vote::Against);
  EXPECT_EQ(VoteOn(view, Vector3d(0, 0, 0.11), 0.1), Vote::Against);
  EXPECT_EQ(VoteOn(view, Vector3d(0, 0, 0.09), 0.1), Vote::None) << "it may be hidden";
  EXPECT_EQ(VoteOn(view, Vector3d(0, 0, 0.99), 0), Vote::None);
  EXPECT_EQ(VoteOn(view, Vector3d(9, 0, 0.99), 0.1), Vote::None) << "beside the map";
}

TEST(ViewVotes, OneViewDoesNotCarveWhatTwoSaw)
{
  const double margin = Squares({ 0, 0, 0 }).MarginOf(0);
  ASSERT_GT(margin, 0.01);
  const double little = 0.05 * margin;
  // The third view errs: it sees the surface deeper than the others.
  const FreespaceUnion carved = Squares({ 0, 0, -8 * margin });
  EXPECT_FALSE(carved.IsFree(Vector3d(0, 0, -little)));
  EXPECT_NEAR(carved.Value(Vector3d(0, 0, -little)), -little, 1e-9);
  // One against one: the paper's rule.
  EXPECT_TRUE(Squares({ 0, -8 * margin }).IsFree(Vector3d(0, 0, -little)));
  // One view that sees a surface before the others' closes nothing.
  EXPECT_TRUE(Squares({ 8 * margin, 0, 0 }).IsFree(Vector3d(0, 0, little)));
}

TEST(ViewVotes, PointsAreFreeByTheVotesOfAllViews)
{
  int free = 0, matter = 0, contradicted = 0;
  for (unsigned int seed = 0; seed < 40; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::srand(seed);
    const FreespaceUnion phi = MakeVotingUnion(seed);
    for (int i = 0; i < 500; ++i)
    {
      const Vector3d point = phi.Hull().Bounds().sample();
      if (phi.Hull().Distance(phi.Hull().NearestPlane(point), point) > 0)
      {
        continue;
      }
      const VoteCount votes = CountVotes(phi, point);
      const bool expected = votes.free >= std::min<int>(3, phi.NumberOfViews()) ||
        (votes.free > 0 && votes.free >= votes.against);
      contradicted += votes.free > 0 && !expected;
      const bool isFree = phi.IsFree(point);
      // The surroundings of cameras are no map's: they can only open more.
      ASSERT_TRUE(seed % 3 == 0 ? isFree >= expected : isFree == expected);
      ASSERT_EQ(phi.IsFree(point, phi.Root()), isFree);
      if (std::abs(phi.Value(point)) > 1e-9)
      {
        ASSERT_EQ(phi.Value(point) > 0, isFree) << phi.Value(point);
      }
      (isFree ? free : matter) += 1;
    }
  }
  EXPECT_GT(free, 1000);
  EXPECT_GT(matter, 1000);
  EXPECT_GT(contradicted, 20);
}

TEST(ViewVotes, BoxesAgreeWithTheirPoints)
{
  int decided = 0;
  for (unsigned int seed = 0; seed < 40; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::srand(seed);
    const FreespaceUnion phi = MakeVotingUnion(seed);
    for (int i = 0; i < 200; ++i)
    {
      const Vector3d low = phi.Hull().Bounds().sample();
      const AlignedBox3d box(low, low + std::pow(0.5, i % 8) * 0.3 * phi.Hull().Bounds().sizes());
      FieldScope scope;
      BoxContent content = phi.Classify(box, phi.ScopeAround(box), scope);
      const BoxContent coarse = content;
      if (content == BoxContent::Mixed)
      {
        content = phi.ClassifyFinely(box, scope);
      }
      decided += content != BoxContent::Mixed;
      for (int j = 0; j < 30; ++j)
      {
        const Vector3d point = box.sample();
        const bool isFree = phi.IsFree(point);
        ASSERT_TRUE(content == BoxContent::Mixed || (content == BoxContent::Free) == isFree);
        if (coarse == BoxContent::Mixed && content == BoxContent::Mixed)
        {
          ASSERT_EQ(phi.IsFree(point, scope), isFree);
        }
      }
    }
  }
  EXPECT_GT(decided, 2000);
}

// Nothing before the crossing is free, and what follows it is, up to places that are narrower than the samples.
TEST(ViewVotes, CrossingsAreTheFirstFreePlaces)
{
  int found = 0;
  for (unsigned int seed = 0; seed < 60; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::srand(seed);
    const FreespaceUnion phi = MakeVotingUnion(seed);
    for (int i = 0; i < 100; ++i)
    {
      const Vector3d matter = phi.Hull().Bounds().sample();
      const Vector3d free = matter + 0.2 * Vector3d::Random();
      if (phi.IsFree(matter) || !phi.IsFree(free))
      {
        continue;
      }
      double place = -1;
      SurfaceLabel label;
      ASSERT_TRUE(phi.Crossing(matter, free, phi.Root(), place, label));
      ++found;
      const auto at = [&](double t) { return Vector3d(matter + t * (free - matter)); };
      for (int k = 0; k < 50; ++k)
      {
        ASSERT_FALSE(phi.IsFree(at((place - 1e-7) * k / 50)));
      }
      ASSERT_FALSE(phi.IsFree(at(place - 1e-7)));
      ASSERT_TRUE(phi.IsFree(at(std::min(1.0, place + 1e-7))));
      ASSERT_TRUE(label.view < 0 || label.normal.norm() < 1 + 1e-9);
      const double blocked = FirstBlocked(phi, free, matter);
      ASSERT_LE(blocked, 1);
      ASSERT_LE(blocked, 1 - place + 1e-7);
    }
  }
  EXPECT_GT(found, 300);
}

TEST(ViewVotes, SegmentsAreFreeUpToWhatBlocksThem)
{
  int blockedSegments = 0, freeSegments = 0;
  for (unsigned int seed = 0; seed < 60; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::srand(seed);
    const FreespaceUnion phi = MakeVotingUnion(seed);
    for (int i = 0; i < 50; ++i)
    {
      const Vector3d first = phi.Hull().Bounds().sample();
      const Vector3d last = phi.Hull().Bounds().sample();
      const double blocked = FirstBlocked(phi, first, last);
      const bool isBlocked = blocked <= 1;
      (isBlocked ? blockedSegments : freeSegments) += 1;
      for (int k = 1; k <= 60; ++k)
      {
        const double place = (isBlocked ? blocked - 1e-7 : 1.0) * k / 60;
        ASSERT_TRUE(place < 0 || phi.IsFree(first + place * (last - first)));
      }
      if (isBlocked && blocked + 1e-7 < 1)
      {
        ASSERT_FALSE(phi.IsFree(first + (blocked + 1e-7) * (last - first)));
      }
    }
  }
  EXPECT_GT(blockedSegments, 500);
  EXPECT_GT(freeSegments, 20);
}

TEST(ViewVotes, GradientIsTheSlopeOfTheValue)
{
  int compared = 0;
  for (unsigned int seed = 0; seed < 40; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::srand(seed);
    const FreespaceUnion phi = MakeVotingUnion(seed);
    for (int i = 0; i < 50; ++i)
    {
      const Vector3d point = phi.Hull().Bounds().sample();
      const Vector3d step = 1e-6 * Vector3d::Random();
      const double before = phi.Value(point - step), after = phi.Value(point + step);
      const Vector3d gradient = phi.Gradient(point);
      // Neither over a wall nor over a ridge of the value.
      if ((phi.Gradient(point - step) - phi.Gradient(point + step)).norm() <
          1e-3 * gradient.norm() &&
        std::abs(after - before) < 1e-3)
      {
        ++compared;
        ASSERT_NEAR((after - before) / 2, gradient.dot(step), 1e-3 * gradient.norm() * step.norm());
      }
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST(ViewVotes, TheMarginMustBePositive)
{
  for (const double contradiction : { 0.0, -1.0, std::nan(""), HUGE_VAL })
  {
    FreespaceUnionOptions options;
    options.contradiction = contradiction;
    EXPECT_THROW(options.Check(), std::exception);
  }
}
