// SPDX-License-Identifier: BSD-3-Clause
#include "Matching/RunFilter.h"

#include <gtest/gtest.h>

#include <vector>

using namespace freespace;

namespace
{

constexpr double FilterBaseline = 100; // a disparity of 0.01 is a pixel

// Chains that are one run each, with a token per pixel.
struct Runs
{
  EdgeChains edges;
  LargeVector<EdgeMatch> matches;
  std::vector<std::pair<int, int>> tokens; // of each run, [begin, end)

  // A horizontal run; returns its number.
  int Add(double x, double y, int count, double disparity)
  {
    const int run = static_cast<int>(this->tokens.size());
    const int begin = static_cast<int>(this->matches.size());
    for (int i = 0; i < count; ++i)
    {
      EdgeToken token{};
      token.position = { x + i, y };
      token.tangent = { 1, 0 };
      this->edges.tokens.push_back(token);
      EdgeMatch match;
      match.images = 2;
      match.run = run;
      match.disparity = disparity;
      match.imagePoint = token.position;
      this->matches.push_back(match);
    }
    this->edges.begin.push_back(begin + count);
    this->tokens.emplace_back(begin, begin + count);
    return run;
  }

  void Filter() { DropLonelyRuns(this->edges, FilterBaseline, MatcherOptions(), this->matches); }

  // A run is kept or dropped as a whole.
  bool IsKept(int run) const
  {
    const auto [begin, end] = this->tokens[run];
    int kept = 0;
    for (int token = begin; token < end; ++token)
    {
      kept += this->matches[token].images > 0;
    }
    EXPECT_TRUE(kept == 0 || kept == end - begin);
    return kept > 0;
  }
};

}

TEST(RunFilter, ARunOfTwentyTokensStandsAlone)
{
  Runs runs;
  const int twenty = runs.Add(0, 0, 20, 0.5), nineteen = runs.Add(0, 200, 19, 0.5);
  runs.Filter();
  EXPECT_TRUE(runs.IsKept(twenty));
  EXPECT_FALSE(runs.IsKept(nineteen));
}

TEST(RunFilter, AShortRunNeedsAnAcceptedOneBesideIt)
{
  Runs runs;
  const int longRun = runs.Add(0, 0, 40, 0.5);
  const int beside = runs.Add(10, 23, 5, 0.5);          // 23 pixels away
  const int away = runs.Add(10, 25, 5, 0.5);            // further than 24 pixels
  const int slanted = runs.Add(10, -20, 5, 0.5 + 0.08); // 8 pixels over 20, slope 0.4
  const int behind = runs.Add(10, 15, 5, 0.2);          // 30 pixels over 15
  runs.Filter();
  EXPECT_TRUE(runs.IsKept(longRun));
  EXPECT_TRUE(runs.IsKept(beside));
  EXPECT_TRUE(runs.IsKept(slanted));
  EXPECT_FALSE(runs.IsKept(behind));
  // Beside the run that is beside the long one: accepted in the next round.
  EXPECT_TRUE(runs.IsKept(away));
}

TEST(RunFilter, AcceptanceSpreadsOverShortRuns)
{
  Runs runs;
  std::vector<int> stairs;
  for (int i = 9; i > 0; --i) // the furthest first
  {
    stairs.push_back(runs.Add(0, 20 * i, 5, 0.5));
  }
  const int island = runs.Add(300, 0, 5, 0.5);
  runs.Add(0, 0, 20, 0.5);
  runs.Filter();
  for (const int run : stairs)
  {
    EXPECT_TRUE(runs.IsKept(run)) << run;
  }
  EXPECT_FALSE(runs.IsKept(island));
}

TEST(RunFilter, HalfOfTheTokensNeedSupport)
{
  for (const int near : { 3, 2 })
  {
    Runs runs;
    runs.Add(0, 0, 20, 0.5); // reaches to x = 19
    // `near` of six tokens lie within 24 pixels of the last one.
    const int run = runs.Add(19 + 24 - near + 1, 0, 6, 0.5);
    runs.Filter();
    EXPECT_EQ(runs.IsKept(run), near == 3);
  }
}

TEST(RunFilter, UnmatchedTokensStayUnmatched)
{
  Runs runs;
  const int run = runs.Add(0, 0, 20, 0.5);
  runs.matches[5] = EdgeMatch();
  runs.Filter();
  EXPECT_EQ(runs.matches[5].images, 0);
  EXPECT_EQ(runs.matches[4].images, 0) << "nineteen are left";
  EXPECT_FALSE(runs.IsKept(run));
}

TEST(RunFilter, NoTokens)
{
  Runs runs;
  runs.Filter();
  EXPECT_TRUE(runs.matches.empty());
}
