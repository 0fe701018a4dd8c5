// SPDX-License-Identifier: BSD-3-Clause
#include "Matching/RunFitting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace freespace;

namespace
{

constexpr double FittingBaseline = 100; // a disparity of 0.01 is a pixel
constexpr float FittingSigma = 0.01f;

// A chain along y = 0 with a token per pixel, each matched in two images.
struct Chain
{
  EdgeChains edges;
  LargeVector<EdgeHypothesis> chosen;
  LargeVector<EdgeCandidate> support;

  Chain(int count, const std::function<double(int)>& disparity)
  {
    for (int i = 0; i < count; ++i)
    {
      EdgeToken token{};
      token.position = { i + 0.5, 0 };
      token.tangent = { 1, 0 };
      token.contrast = 100;
      this->edges.tokens.push_back(token);
      EdgeHypothesis hypothesis;
      hypothesis.begin = 2 * i;
      hypothesis.count = 2;
      this->chosen.push_back(hypothesis);
      for (int image = 0; image < 2; ++image)
      {
        this->support.push_back({ disparity(i), FittingSigma, 0, 0.1f, image, i });
      }
    }
    this->edges.begin.push_back(count);
  }

  LargeVector<EdgeMatch> Match(const MatcherOptions& options = {}) const
  {
    return MatchRuns(this->edges, this->chosen, this->support, FittingBaseline, options);
  }
};

int CountMatches(const LargeVector<EdgeMatch>& matches)
{
  int count = 0;
  for (const EdgeMatch& match : matches)
  {
    count += match.images > 0;
  }
  return count;
}

}

TEST(RunFitting, ASlantedLineIsItself)
{
  const auto disparity = [](int i) { return 0.5 + 0.001 * i; };
  const Chain chain(40, disparity);
  const auto matches = chain.Match();
  for (int i = 0; i < 40; ++i)
  {
    EXPECT_EQ(matches[i].images, 2) << i;
    EXPECT_EQ(matches[i].run, 0) << i;
    EXPECT_NEAR(matches[i].disparity, disparity(i), 1e-12) << i;
    EXPECT_NEAR(matches[i].cost, 0.1, 1e-6) << i;
    EXPECT_LT((matches[i].imagePoint - chain.edges.tokens[i].position).norm(), 1e-12) << i;
  }
}

// The disparity d and the shift t across the edge of the point nearest to all edge lines: by least
// squares of (d - shift t - disparity) / sigma and t.
TEST(RunFitting, PointsAreNearestToAllEdgeLines)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<float> unit(-1, 1);
  for (int trial = 0; trial < 100; ++trial)
  {
    Chain chain(10, [](int) { return 0.5; });
    Eigen::Matrix<double, 3, 2> rows;
    Eigen::Vector3d right;
    for (int image = 0; image < 2; ++image)
    {
      EdgeCandidate& candidate = chain.support[image];
      candidate.sigma = FittingSigma * (1 + 0.3f * unit(random));
      candidate.shift = 0.01f * unit(random);
      candidate.disparity = 0.5 + 0.001 * unit(random);
      rows.row(image) << 1 / double(candidate.sigma), -candidate.shift / double(candidate.sigma);
      right[image] = candidate.disparity / candidate.sigma;
    }
    rows.row(2) << 0, 1;
    right[2] = 0;
    for (std::size_t k = 2; k < chain.support.size(); ++k)
    {
      chain.support[k] = chain.support[k % 2]; // the same for all tokens
    }
    const Eigen::Vector2d best = rows.colPivHouseholderQr().solve(right);
    const auto matches = chain.Match();
    for (int i = 0; i < 10; ++i)
    {
      ASSERT_EQ(matches[i].images, 2);
      EXPECT_NEAR(matches[i].disparity, best[0], 1e-9);
      EXPECT_NEAR(matches[i].imagePoint.x(), i + 0.5, 1e-12);
      EXPECT_NEAR(matches[i].imagePoint.y(), best[1], 1e-7) << "across the edge";
    }
  }
}

TEST(RunFitting, AJumpCutsTheChain)
{
  const auto matches = Chain(20, [](int i) { return i < 8 ? 0.5 : 0.9; }).Match();
  for (int i = 0; i < 20; ++i)
  {
    EXPECT_EQ(matches[i].run, i < 8 ? 0 : 1) << i;
    EXPECT_NEAR(matches[i].disparity, i < 8 ? 0.5 : 0.9, 1e-12) << i;
  }
}

TEST(RunFitting, AGapOfMoreThanTwelvePixelsCutsTheChain)
{
  for (const int gap : { 12, 13 })
  {
    Chain chain(40, [](int) { return 0.5; });
    for (int i = 10; i < 10 + gap - 1; ++i)
    {
      chain.chosen[i].count = 0;
    }
    const auto matches = chain.Match();
    EXPECT_EQ(matches[0].run, 0);
    EXPECT_EQ(matches[39].run, gap == 12 ? 0 : 1);
    EXPECT_EQ(CountMatches(matches), 40 - (gap - 1));
  }
}

TEST(RunFitting, WhatDoesNotLieOnTheLineIsDropped)
{
  const auto matches = Chain(30, [](int i) { return i == 15 ? 0.506 : 0.5; }).Match();
  for (int i = 0; i < 30; ++i)
  {
    EXPECT_EQ(matches[i].images, i == 15 ? 0 : 2) << i;
  }
  EXPECT_EQ(matches[29].run, 0) << "the run goes on";
}

TEST(RunFitting, UnconfirmedTokensOnlyCloseGaps)
{
  Chain chain(20, [](int) { return 0.5; });
  for (const int i : { 0, 1, 9, 10, 19 })
  {
    chain.chosen[i].count = 1;
  }
  const auto matches = chain.Match();
  for (int i = 0; i < 20; ++i)
  {
    EXPECT_EQ(matches[i].images, i < 2 || i == 19 ? 0 : i == 9 || i == 10 ? 1 : 2) << i;
  }
}

TEST(RunFitting, RunsMustBeLongEnough)
{
  MatcherOptions options;
  options.minimumRun = 6;
  EXPECT_EQ(CountMatches(Chain(5, [](int) { return 0.5; }).Match(options)), 0);
  EXPECT_EQ(CountMatches(Chain(6, [](int) { return 0.5; }).Match(options)), 6);
}

TEST(RunFitting, CostlyAndInfiniteMatchesAreDropped)
{
  MatcherOptions options;
  options.maximumCost = 0.09;
  EXPECT_EQ(CountMatches(Chain(10, [](int) { return 0.5; }).Match(options)), 0);
  EXPECT_EQ(CountMatches(Chain(10, [](int) { return 0.0; }).Match()), 0) << "at infinity";
  EXPECT_EQ(CountMatches(Chain(10, [](int) { return -0.5; }).Match()), 0) << "behind the camera";
}

TEST(RunFitting, NoTokens)
{
  EXPECT_TRUE(MatchRuns(EdgeChains(), {}, {}, FittingBaseline, MatcherOptions()).empty());
  const Chain empty(0, [](int) { return 0.5; });
  EXPECT_TRUE(empty.Match().empty());
}

TEST(RunFitting, NoHypotheses)
{
  Chain chain(10, [](int) { return 0.5; });
  for (EdgeHypothesis& hypothesis : chain.chosen)
  {
    hypothesis.count = 0;
  }
  EXPECT_EQ(CountMatches(chain.Match()), 0);
}
