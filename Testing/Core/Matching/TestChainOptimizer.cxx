// SPDX-License-Identifier: BSD-3-Clause
// The choice along a chain: by hand, and against all combinations of the tokens' hypotheses.
#include "Matching/ChainOptimizer.h"

#include "Matching/RunFitting.h"
#include "Support/SyntheticImages.h"
#include "Support/Core/EdgeSides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace freespace;

namespace
{

// A vertical chain of tokens a pixel apart, from row 100 + first + 0.25 on.
void AddPieceOfLine(EdgeChains& edges, double column, int first, int tokens, int bright, int dark)
{
  for (int i = 0; i < tokens; ++i)
  {
    EdgeToken& token = edges.tokens.emplace_back();
    token.position = { column, 100.25 + first + i };
    token.tangent = { 0, 1 };
    token.contrast = 100;
    token.bright = SideOf(bright);
    token.dark = SideOf(dark);
  }
  edges.begin.push_back(static_cast<int>(edges.tokens.size()));
}

// A vertical chain of the reference at column 320, and what two other images, 0.1 to the left and 0.2 to the right,
// show. Every token of the chain searches.
struct Scene
{
  explicit Scene(int tokens)
    : reference{ ParallelCamera(0), {} }
    , others{ { ParallelCamera(-0.1), {} }, { ParallelCamera(0.2), {} } }
  {
    AddPieceOfLine(this->reference.edges, 320, 1, tokens, 150, 60);
    this->options.minimumRun = 1;
  }

  // A line at a disparity, from a token on; darker than that of the reference by some grey levels.
  void Add(double disparity, int first, int tokens, int darker = 0)
  {
    AddPieceOfLine(
      this->others[0].edges, 320 + 50 * disparity, first, tokens, 150 - darker, 60 - darker / 2);
    AddPieceOfLine(
      this->others[1].edges, 320 - 100 * disparity, first, tokens, 150 - darker, 60 - darker / 2);
  }

  int Tokens() const { return static_cast<int>(this->reference.edges.tokens.size()); }

  MatcherOptions options;
  ImageEdges reference;
  std::vector<ImageEdges> others;
};

// The sum of the scores and of the costs of the steps. `path` has a hypothesis per token.
double CostOf(
  const std::vector<const EdgeHypothesis*>& path, double baseline, const MatcherOptions& options)
{
  double cost = path[0]->score;
  for (std::size_t i = 1; i < path.size(); ++i)
  {
    const EdgeHypothesis &from = *path[i - 1], &to = *path[i];
    cost += to.score;
    if (from.Empty() || to.Empty())
    {
      cost += from.Empty() == to.Empty() ? 0 : 0.3; // a match begins or ends
    }
    else
    {
      cost += std::min(1.5, 0.5 * DisparityJump(from, to, 1, baseline, options));
    }
  }
  return cost;
}

// The hypotheses of a token that searches all its lines.
std::vector<EdgeHypothesis> HypothesesOf(
  int token, const Scene& scene, CandidateSearch& search, HypothesisBuilder& builder)
{
  search.Candidates.clear();
  search.FindLines(token);
  search.FindCandidates(token, std::vector<char>(scene.others.size(), 0));
  const TokenStates states = builder.FindHypotheses(token);
  return { builder.States.begin() + states.begin, builder.States.begin() + states.end };
}

}

TEST(ChainOptimizer, WithoutCandidatesNothingIsMatched)
{
  const Scene scene(10);
  ChainOptimizer optimizer(scene.reference, scene.others, scene.options);
  EXPECT_FALSE(optimizer.ChooseAlongChain(0, 10));
  for (const EdgeHypothesis& chosen : optimizer.Chosen)
  {
    EXPECT_TRUE(chosen.Empty());
  }
  EXPECT_TRUE(optimizer.Support.empty());
}

TEST(ChainOptimizer, AChainOfOneToken)
{
  Scene scene(1);
  scene.Add(0.4, 0, 5);
  ChainOptimizer optimizer(scene.reference, scene.others, scene.options);
  EXPECT_FALSE(optimizer.ChooseAlongChain(0, 1));
  EXPECT_TRUE(optimizer.Chosen[0].Confirmed());
  EXPECT_NEAR(optimizer.Chosen[0].disparity, 0.4, 1e-6);
}

// Whether every token searches, or most follow their neighbours.
TEST(ChainOptimizer, ALineIsMatchedAlongAllOfIt)
{
  for (const int minimumRun : { 1, 4 })
  {
    Scene scene(30);
    scene.options.minimumRun = minimumRun;
    scene.Add(0.4, 0, 32);
    ChainOptimizer optimizer(scene.reference, scene.others, scene.options);
    EXPECT_FALSE(optimizer.ChooseAlongChain(0, 30)) << "nothing is ambiguous";
    for (const EdgeHypothesis& chosen : optimizer.Chosen)
    {
      ASSERT_EQ(chosen.count, 2) << minimumRun;
      EXPECT_NEAR(chosen.disparity, 0.4, 1e-6) << minimumRun;
      for (int k = chosen.begin; k < chosen.begin + chosen.count; ++k)
      {
        EXPECT_NEAR(optimizer.Support[k].disparity, 0.4, 1e-6) << minimumRun;
      }
    }
  }
}

TEST(ChainOptimizer, TwoLinesThatLookAlikeAreAmbiguous)
{
  Scene scene(20);
  scene.Add(0.4, 0, 22);
  scene.Add(0.9, 0, 22);
  ChainOptimizer optimizer(scene.reference, scene.others, scene.options);
  EXPECT_TRUE(optimizer.ChooseAlongChain(0, 20));
  // Known matches at one of them decide.
  for (const double usual : { 0.4, 0.9 })
  {
    optimizer.SetPrior(std::make_unique<DisparityPrior>(
      std::vector<Eigen::Vector2d>{ { 320, 110 } }, std::vector<double>{ usual }));
    EXPECT_FALSE(optimizer.ChooseAlongChain(0, 20)) << usual;
    for (const EdgeHypothesis& chosen : optimizer.Chosen)
    {
      EXPECT_NEAR(chosen.disparity, usual, 1e-6);
    }
  }
}

// To leave a line and come back to it costs two breaks, which a few better tokens do not pay for. All images have about
// as many tokens of each colour, so that exposures need no compensation.
TEST(ChainOptimizer, AJumpMustPayForItsBreaks)
{
  for (const auto& [tokens, jumps] : { std::pair(2, false), std::pair(20, true) })
  {
    Scene scene(30);
    scene.Add(0.4, 0, 32, 50); // darker than it should be
    scene.Add(0.9, 5, tokens + 1);
    AddPieceOfLine(scene.reference.edges, 10, 1, 32, 100, 35);
    for (ImageEdges& image : scene.others)
    {
      AddPieceOfLine(
        image.edges, 630, 1, 30 - tokens, 150, 60); // beyond what the other image can confirm
    }
    ChainOptimizer optimizer(scene.reference, scene.others, scene.options);
    optimizer.ChooseAlongChain(0, 30);
    const auto isAt = [](double disparity)
    {
      return [disparity](const EdgeHypothesis& chosen)
      { return chosen.Confirmed() && std::abs(chosen.disparity - disparity) < 1e-5; };
    };
    const auto begin = optimizer.Chosen.begin(), end = begin + 30;
    const auto near = std::count_if(begin, end, isAt(0.9));
    const auto far = std::count_if(begin, end, isAt(0.4));
    EXPECT_GE(near + far, 28) << "a token without a match may stand between: " << tokens;
    EXPECT_EQ(near > 0, jumps) << tokens;
    EXPECT_TRUE(near == 0 || near >= tokens - 1) << near << " of " << tokens;
  }
}

// Lines of random colours per token, so that none of them ever looks so good that the search ends: then the
// hypotheses of each token are those of a search of its own, and all combinations of them can be tried.
TEST(ChainOptimizer, NoCombinationIsCheaper)
{
  std::mt19937 random(9);
  std::uniform_int_distribution<int> grey(0, 60), lines(1, 3), length(2, 6);
  std::uniform_real_distribution<double> place(0, 0.2);
  int compared = 0, changes = 0;
  for (int trial = 0; trial < 400; ++trial)
  {
    Scene scene(length(random));
    const double first = place(random);
    const int count = lines(random);
    for (int line = 0; line < count; ++line)
    {
      scene.Add(first + 0.05 * line + 0.04 * place(random), 0, scene.Tokens() + 3);
    }
    for (ImageEdges& image : scene.others)
    {
      for (EdgeToken& token : image.edges.tokens)
      {
        token.position.x() += place(random);
        token.bright = SideOf(120 + grey(random));
        token.dark = SideOf(40 + grey(random) / 2);
      }
    }
    for (EdgeToken& token : scene.reference.edges.tokens)
    {
      token.bright = SideOf(120 + grey(random));
      token.dark = SideOf(40 + grey(random) / 2);
    }
    CandidateSearch search(scene.reference, scene.others, scene.options);
    HypothesisBuilder builder(scene.reference.edges, search, scene.options);
    search.FindRays(0, scene.Tokens());
    std::vector<std::vector<EdgeHypothesis>> hypotheses;
    std::size_t combinations = 1;
    bool isAlone = true; // each token's search
    for (int token = 0; token < scene.Tokens(); ++token)
    {
      hypotheses.push_back(HypothesesOf(token, scene, search, builder));
      combinations *= hypotheses.back().size();
      const EdgeHypothesis& best = hypotheses.back().front();
      isAlone = isAlone && (!best.Confirmed() || best.score > (0.12 - 1) * best.count) &&
        std::all_of(hypotheses.back().begin(), hypotheses.back().end(),
          [](const EdgeHypothesis& each) { return each.Empty() || each.promising; });
    }
    if (!isAlone)
    {
      continue;
    }
    double cheapest = std::numeric_limits<double>::infinity();
    std::vector<const EdgeHypothesis*> path(hypotheses.size());
    for (std::size_t n = 0; n < combinations; ++n)
    {
      std::size_t rest = n;
      for (std::size_t token = 0; token < path.size(); ++token)
      {
        path[token] = &hypotheses[token][rest % hypotheses[token].size()];
        rest /= hypotheses[token].size();
      }
      cheapest = std::min(cheapest, CostOf(path, search.LongestBaseline(), scene.options));
    }
    ChainOptimizer optimizer(scene.reference, scene.others, scene.options);
    optimizer.ChooseAlongChain(0, scene.Tokens());
    for (std::size_t token = 0; token < path.size(); ++token)
    {
      path[token] = &optimizer.Chosen[token];
      changes += path[token]->score > hypotheses[token].front().score + 1e-6;
    }
    EXPECT_NEAR(CostOf(path, search.LongestBaseline(), scene.options), cheapest, 1e-4) << trial;
    ++compared;
  }
  EXPECT_GT(compared, 50);
  EXPECT_GT(changes, 20) << "the best of the chain is often not the best of its token";
}
