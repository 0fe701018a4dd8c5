// SPDX-License-Identifier: BSD-3-Clause
#include "Matching/HypothesisBuilder.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace freespace
{

HypothesisBuilder::HypothesisBuilder(
  const EdgeChains& edges, CandidateSearch& search, const MatcherOptions& options)
  : Edges(edges)
  , Search(search)
  , Options(options)
  , Agreeing(search.NumberOfImages())
  , AgreeingCost(search.NumberOfImages())
{
}

TokenStates HypothesisBuilder::FindHypotheses(int token)
{
  TokenStates states;
  states.begin = static_cast<int>(this->States.size());
  this->Found.clear();
  std::sort(this->Search.Candidates.begin(), this->Search.Candidates.end(),
    [](const EdgeCandidate& a, const EdgeCandidate& b)
    {
      return a.disparity != b.disparity ? a.disparity < b.disparity
                                        : std::tie(a.image, a.token) < std::tie(b.image, b.token);
    });
  double widest = 0;
  for (const EdgeCandidate& candidate : this->Search.Candidates)
  {
    widest =
      std::max(widest, CandidateSearch::Promising * this->Options.tolerance * candidate.sigma);
  }
  std::size_t begin = 0, end = 0;
  for (const EdgeCandidate& seed : this->Search.Candidates)
  {
    while (this->Search.Candidates[begin].disparity < seed.disparity - widest)
    {
      ++begin;
    }
    while (end < this->Search.Candidates.size() &&
      this->Search.Candidates[end].disparity <= seed.disparity + widest)
    {
      ++end;
    }
    this->Confirm(seed, begin, end);
  }
  this->ApplyPrior(token);
  this->KeepBest();
  this->States.emplace_back(); // no match
  states.end = static_cast<int>(this->States.size());
  return states;
}

// Makes a hypothesis of one candidate and all that agree with it, at most one from each image.
void HypothesisBuilder::Confirm(const EdgeCandidate& seed, std::size_t begin, std::size_t end)
{
  constexpr float distance = 0.2f; // share of the distance in the cost
  std::fill(this->Agreeing.begin(), this->Agreeing.end(), nullptr);
  std::fill(this->AgreeingCost.begin(), this->AgreeingCost.end(), 1.0f);
  EdgeHypothesis hypothesis;
  for (std::size_t i = begin; i < end; ++i)
  {
    const EdgeCandidate& other = this->Search.Candidates[i];
    const double difference = std::abs(other.disparity - seed.disparity);
    const double most = this->Options.tolerance * std::max(seed.sigma, other.sigma);
    if (other.image == seed.image || difference > CandidateSearch::Promising * most)
    {
      continue;
    }
    hypothesis.promising = true;
    if (difference > most)
    {
      continue;
    }
    const float off = static_cast<float>(difference / most);
    const float cost = (1 - distance) * other.cost + distance * off;
    if (cost < this->AgreeingCost[other.image])
    {
      this->Agreeing[other.image] = &other;
      this->AgreeingCost[other.image] = cost;
    }
  }
  this->Agreeing[seed.image] = &seed;
  this->AgreeingCost[seed.image] = seed.cost;

  hypothesis.begin = static_cast<int>(this->Support.size());
  double weights = 0;
  for (std::size_t image = 0; image < this->Search.NumberOfImages(); ++image)
  {
    if (const EdgeCandidate* candidate = this->Agreeing[image])
    {
      const double weight = candidate->Weight();
      weights += weight;
      hypothesis.disparity += weight * candidate->disparity;
      hypothesis.score += this->AgreeingCost[image] - 1;
      this->Support.push_back(*candidate);
      this->Support.back().cost = this->AgreeingCost[image];
      ++hypothesis.count;
    }
  }
  constexpr float unconfirmed = 0.3f; // worth of a match in one image only
  hypothesis.disparity /= weights;
  hypothesis.sigma = static_cast<float>(1 / std::sqrt(weights));
  hypothesis.score *= hypothesis.Confirmed() ? 1 : unconfirmed;
  this->Found.push_back(hypothesis);
}

// A repeated pattern matches itself at several disparities: the one closest to the prior is preferred.
void HypothesisBuilder::ApplyPrior(int token)
{
  constexpr double weight = 0.4, scale = 8; // pixels of the longest baseline
  const double usual = this->Prior ? this->Prior->At(this->Edges.tokens[token].position) : 0;
  for (EdgeHypothesis& hypothesis : this->Found)
  {
    if (usual > 0)
    {
      const double off =
        std::abs(hypothesis.disparity - usual) * this->Search.LongestBaseline() / scale;
      hypothesis.score += static_cast<float>(weight * std::min(1.0, off));
    }
  }
}

// Hypotheses that differ by less than half a tolerance are the same one.
void HypothesisBuilder::KeepBest()
{
  constexpr std::size_t maximum = 6; // hypotheses of a token
  this->Order.clear();
  for (const EdgeHypothesis& hypothesis : this->Found)
  {
    this->Order.emplace_back(hypothesis.score, static_cast<int>(this->Order.size()));
  }
  std::sort(this->Order.begin(), this->Order.end());
  const std::size_t first = this->States.size();
  for (const auto& [score, index] : this->Order)
  {
    const EdgeHypothesis& hypothesis = this->Found[index];
    const bool known = std::any_of(this->States.begin() + first, this->States.end(),
      [&](const EdgeHypothesis& other)
      {
        return std::abs(hypothesis.disparity - other.disparity) <
          this->Options.tolerance / 2 * std::min(hypothesis.sigma, other.sigma);
      });
    if (!known)
    {
      this->States.push_back(hypothesis);
      if (this->States.size() == first + maximum)
      {
        break;
      }
    }
  }
}

}
