// SPDX-License-Identifier: BSD-3-Clause
// The confirmation by a third image: by hand, and against a comparison of all pairs of candidates.
#include "Matching/HypothesisBuilder.h"

#include "Support/SyntheticImages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

using namespace freespace;

namespace
{

constexpr float HypothesisSigma = 0.01F;

EdgeCandidate Candidate(
  int image, double disparity, float cost = 0.1F, float sigma = HypothesisSigma)
{
  EdgeCandidate candidate{};
  candidate.image = image;
  candidate.disparity = disparity;
  candidate.cost = cost;
  candidate.sigma = sigma;
  return candidate;
}

// One token at pixel (100, 100), three other images, the farthest 0.4 away, and candidates that a test gives.
class HypothesisTrial
{
public:
  HypothesisTrial()
    : Reference{ CameraAt(0), OneToken() }
    , Others{ { CameraAt(0.1), {} }, { CameraAt(-0.2), {} }, { CameraAt(0.4), {} } }
    , Search(this->Reference, this->Others, this->Options)
    , Builder(this->Reference.edges, this->Search, this->Options)
  {
  }

  // The hypotheses, "no match" included.
  std::vector<EdgeHypothesis> Find(const std::vector<EdgeCandidate>& candidates)
  {
    this->Search.Candidates = candidates;
    const TokenStates states = this->Builder.FindHypotheses(0);
    return { this->Builder.States.begin() + states.begin,
      this->Builder.States.begin() + states.end };
  }

  MatcherOptions Options;
  ImageEdges Reference;
  std::vector<ImageEdges> Others;
  CandidateSearch Search;
  HypothesisBuilder Builder;

private:
  static Camera CameraAt(double x) { return ParallelCamera(x, 640, 480, 500); }
  static EdgeChains OneToken()
  {
    EdgeChains edges;
    EdgeToken& token = edges.tokens.emplace_back();
    token.position = { 100, 100 };
    token.tangent = { 0, 1 };
    token.contrast = 100;
    edges.begin = { 0, 1 };
    return edges;
  }
};

// What each candidate makes with those that agree with it, and of these the best that differ.
std::vector<EdgeHypothesis> ByAllPairs(
  const std::vector<EdgeCandidate>& candidates, const MatcherOptions& options)
{
  std::vector<EdgeHypothesis> all;
  for (const EdgeCandidate& seed : candidates)
  {
    EdgeHypothesis hypothesis;
    std::map<int, std::pair<double, const EdgeCandidate*>> best = { { seed.image,
      { seed.cost, &seed } } };
    for (const EdgeCandidate& other : candidates)
    {
      const double off = std::abs(other.disparity - seed.disparity) /
        (options.tolerance * std::max(seed.sigma, other.sigma));
      if (other.image == seed.image || off > 2)
      {
        continue;
      }
      hypothesis.promising = true;
      const double cost = 0.8 * other.cost + 0.2 * off;
      const auto known = best.find(other.image);
      if (off <= 1 && (known == best.end() || cost < known->second.first))
      {
        best[other.image] = { cost, &other };
      }
    }
    double weights = 0, score = 0;
    for (const auto& [image, choice] : best)
    {
      const double weight = 1 / std::pow(static_cast<double>(choice.second->sigma), 2);
      weights += weight;
      hypothesis.disparity += weight * choice.second->disparity;
      score += choice.first - 1;
    }
    hypothesis.count = static_cast<int>(best.size());
    hypothesis.disparity /= weights;
    hypothesis.sigma = static_cast<float>(1 / std::sqrt(weights));
    hypothesis.score = static_cast<float>(hypothesis.count > 1 ? score : 0.3 * score);
    all.push_back(hypothesis);
  }
  std::sort(all.begin(), all.end(),
    [](const EdgeHypothesis& a, const EdgeHypothesis& b) { return a.score < b.score; });
  std::vector<EdgeHypothesis> kept;
  for (const EdgeHypothesis& hypothesis : all)
  {
    const auto isSame = [&](const EdgeHypothesis& other)
    {
      return std::abs(other.disparity - hypothesis.disparity) <
        options.tolerance / 2 * std::min(other.sigma, hypothesis.sigma);
    };
    if (kept.size() < 6 && std::none_of(kept.begin(), kept.end(), isSame))
    {
      kept.push_back(hypothesis);
    }
  }
  return kept;
}

}

TEST(HypothesisBuilder, WithoutCandidatesThereIsNoMatch)
{
  HypothesisTrial trial;
  const auto found = trial.Find({});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].Empty());
  EXPECT_EQ(found[0].score, 0);
  EXPECT_TRUE(trial.Builder.Support.empty());
}

// Two that are half a tolerance apart: one hypothesis, in their middle.
TEST(HypothesisBuilder, AThirdImageConfirms)
{
  HypothesisTrial trial;
  const double apart = 0.5 * trial.Options.tolerance * HypothesisSigma;
  const auto found = trial.Find({ Candidate(0, 0.5), Candidate(1, 0.5 + apart) });
  ASSERT_EQ(found.size(), 2u);
  EXPECT_TRUE(found[0].Confirmed());
  EXPECT_TRUE(found[0].promising);
  EXPECT_NEAR(found[0].disparity, 0.5 + apart / 2, 1e-9);
  EXPECT_NEAR(found[0].sigma, HypothesisSigma / std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(found[0].score, (0.1 - 1) + (0.8 * 0.1 + 0.2 * 0.5 - 1), 1e-5);
  EXPECT_TRUE(found[1].Empty());
  // Its support: both, in the order of their images.
  ASSERT_EQ(found[0].count, 2);
  EXPECT_EQ(trial.Builder.Support[found[0].begin].image, 0);
  EXPECT_EQ(trial.Builder.Support[found[0].begin + 1].image, 1);
}

TEST(HypothesisBuilder, BeyondTheToleranceNothingIsConfirmed)
{
  HypothesisTrial trial;
  for (const auto& [tolerances, isPromising] : { std::pair(1.5, true), std::pair(2.5, false) })
  {
    const double apart = tolerances * trial.Options.tolerance * HypothesisSigma;
    const auto found = trial.Find({ Candidate(0, 0.5), Candidate(1, 0.5 + apart) });
    ASSERT_EQ(found.size(), 3u) << tolerances;
    for (int i = 0; i < 2; ++i)
    {
      EXPECT_FALSE(found[i].Confirmed()) << tolerances;
      EXPECT_EQ(found[i].promising, isPromising) << tolerances;
      EXPECT_NEAR(found[i].score, 0.3 * (0.1 - 1), 1e-6) << tolerances;
    }
  }
}

// The less certain of two decides: a short baseline cannot contradict a long one.
TEST(HypothesisBuilder, TheToleranceIsThatOfTheLessCertain)
{
  HypothesisTrial trial;
  const double apart = 0.9 * trial.Options.tolerance * 5 * HypothesisSigma;
  const auto found =
    trial.Find({ Candidate(0, 0.5, 0.1F, 5 * HypothesisSigma), Candidate(2, 0.5 + apart) });
  ASSERT_FALSE(found.empty());
  EXPECT_TRUE(found[0].Confirmed());
  EXPECT_NEAR(found[0].disparity, (0.5 / 25 + 0.5 + apart) / (1 + 1.0 / 25), 1e-9);
}

TEST(HypothesisBuilder, OneImageConfirmsNothing)
{
  HypothesisTrial trial;
  const auto found = trial.Find({ Candidate(1, 0.5), Candidate(1, 0.502), Candidate(1, 0.504) });
  for (const EdgeHypothesis& hypothesis : found)
  {
    EXPECT_FALSE(hypothesis.Confirmed());
    EXPECT_FALSE(hypothesis.promising);
  }
  EXPECT_GT(found.size(), 1u);
}

// A pattern that matches at two disparities alike: the one closer to the prior comes first.
TEST(HypothesisBuilder, ThePriorDecidesBetweenEquals)
{
  const std::vector<EdgeCandidate> candidates = { Candidate(0, 0.5), Candidate(1, 0.5),
    Candidate(0, 0.9), Candidate(1, 0.9) };
  for (const double usual : { 0.5, 0.9 })
  {
    HypothesisTrial trial;
    trial.Builder.SetPrior(std::make_unique<DisparityPrior>(
      std::vector<Eigen::Vector2d>{ { 100, 100 } }, std::vector<double>{ usual }));
    const auto found = trial.Find(candidates);
    ASSERT_EQ(found.size(), 3u);
    EXPECT_NEAR(found[0].disparity, usual, 1e-9);
    const double score = (0.1 - 1) + (0.8 * 0.1 - 1); // the second is no distance away
    EXPECT_NEAR(found[0].score, score, 1e-5);
    // 0.4 of disparity are 80 pixels of the longest baseline, more than the eight that count.
    EXPECT_NEAR(found[1].score, score + 0.4, 1e-5);
  }
}

TEST(HypothesisBuilder, ATokenHasSixHypothesesAtMost)
{
  HypothesisTrial trial;
  std::vector<EdgeCandidate> candidates;
  for (int i = 0; i < 10; ++i)
  {
    candidates.push_back(Candidate(0, 0.1 * i, 0.05F * static_cast<float>(i)));
    candidates.push_back(Candidate(1, 0.1 * i, 0.05F * static_cast<float>(i)));
  }
  const auto found = trial.Find(candidates);
  ASSERT_EQ(found.size(), 7u);
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(found[i].disparity, 0.1 * i, 1e-9) << "the best first";
  }
  EXPECT_TRUE(found[6].Empty());
}

TEST(HypothesisBuilder, FindsWhatAllPairsSay)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> disparity(0, 0.3);
  std::uniform_real_distribution<float> cost(0, 0.9F), sigma(0.003F, 0.02F);
  std::uniform_int_distribution<int> image(0, 2), number(1, 25);
  int confirmed = 0, three = 0, alone = 0;
  for (int round = 0; round < 500; ++round)
  {
    HypothesisTrial trial;
    std::vector<EdgeCandidate> candidates;
    for (int i = number(random); i > 0; --i)
    {
      candidates.push_back(
        Candidate(image(random), disparity(random), cost(random), sigma(random)));
    }
    const auto expected = ByAllPairs(candidates, trial.Options);
    const auto found = trial.Find(candidates);
    ASSERT_EQ(found.size(), expected.size() + 1) << round;
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      EXPECT_NEAR(found[i].score, expected[i].score, 1e-5) << round;
      EXPECT_NEAR(found[i].disparity, expected[i].disparity, 1e-7) << round;
      EXPECT_NEAR(found[i].sigma, expected[i].sigma, 1e-6) << round;
      EXPECT_EQ(found[i].count, expected[i].count) << round;
      EXPECT_EQ(found[i].promising, expected[i].promising) << round;
      confirmed += found[i].Confirmed();
      three += found[i].count == 3;
      alone += !found[i].promising;
    }
    EXPECT_TRUE(found.back().Empty());
  }
  EXPECT_GT(confirmed, 500) << "all kinds occur";
  EXPECT_GT(three, 50);
  EXPECT_GT(alone, 50);
}
