// SPDX-License-Identifier: BSD-3-Clause
#include "Matching/TrinocularMatcher.h"

#include "Common/Error.h"
#include "Epipolar/EpipolarPair.h"
#include "Matching/ChainOptimizer.h"
#include "Matching/DisparityPrior.h"
#include "Matching/RunFilter.h"
#include "Matching/RunFitting.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

namespace freespace
{

namespace
{

// The rounds over all chains.
class Matcher
{
public:
  Matcher(const ImageEdges& reference, const std::vector<ImageEdges>& others,
    const MatcherOptions& options)
    : Edges(reference.edges)
    , Options(options)
    , Optimizer(reference, others, options)
  {
  }

  LargeVector<EdgeMatch> Match();

  // The tokens that support the matches.
  LargeVector<EdgeCandidate> TakeSupport() { return std::move(this->Optimizer.Support); }

private:
  void LearnPrior(const std::vector<std::size_t>& ambiguous);
  void EnforceUniqueness();

  const EdgeChains& Edges; // of the reference
  const MatcherOptions& Options;
  ChainOptimizer Optimizer;
};

LargeVector<EdgeMatch> Matcher::Match()
{
  std::vector<std::size_t> ambiguous; // chains
  for (std::size_t chain = 0; chain < this->Edges.NumberOfChains(); ++chain)
  {
    if (this->Optimizer.ChooseAlongChain(this->Edges.begin[chain], this->Edges.begin[chain + 1]))
    {
      ambiguous.push_back(chain);
    }
  }
  this->LearnPrior(ambiguous);
  for (std::size_t chain : ambiguous)
  {
    this->Optimizer.ChooseAlongChain(this->Edges.begin[chain], this->Edges.begin[chain + 1]);
  }
  this->EnforceUniqueness();
  LargeVector<EdgeMatch> matches = MatchRuns(this->Edges, std::move(this->Optimizer.Chosen),
    this->Optimizer.Support, this->Optimizer.Images().LongestBaseline(), this->Options);
  DropLonelyRuns(this->Edges, this->Optimizer.Images().LongestBaseline(), this->Options, matches);
  return matches;
}

// Derives a prior from the chains with unambiguous matches.
void Matcher::LearnPrior(const std::vector<std::size_t>& ambiguous)
{
  std::vector<char> sure(this->Edges.tokens.size(), 1);
  for (std::size_t chain : ambiguous)
  {
    std::fill(
      sure.begin() + this->Edges.begin[chain], sure.begin() + this->Edges.begin[chain + 1], 0);
  }
  std::vector<Eigen::Vector2d> pixels;
  std::vector<double> disparities;
  for (std::size_t i = 0; i < sure.size(); ++i)
  {
    if (sure[i] && this->Optimizer.Chosen[i].Confirmed())
    {
      pixels.push_back(this->Edges.tokens[i].position);
      disparities.push_back(this->Optimizer.Chosen[i].disparity);
    }
  }
  this->Optimizer.SetPrior(std::make_unique<DisparityPrior>(pixels, disparities));
}

// A token of another image goes to the best of the tokens that claim it; neighbours along one edge
// may share it.
void Matcher::EnforceUniqueness()
{
  constexpr double neighbor = 3; // pixels
  std::vector<std::vector<int>> owners;
  const CandidateSearch& images = this->Optimizer.Images();
  for (std::size_t image = 0; image < images.NumberOfImages(); ++image)
  {
    owners.emplace_back(images.NumberOfTokens(image), -1);
  }
  const auto visitSupport = [this](int token, auto&& visit)
  {
    const EdgeHypothesis& hypothesis = this->Optimizer.Chosen[token];
    for (int k = hypothesis.begin; k < hypothesis.begin + hypothesis.count; ++k)
    {
      visit(this->Optimizer.Support[k]);
    }
  };
  const int count = static_cast<int>(this->Optimizer.Chosen.size());
  for (int token = 0; token < count; ++token)
  {
    visitSupport(token,
      [&](const EdgeCandidate& candidate)
      {
        int& owner = owners[candidate.image][candidate.token];
        if (owner < 0 || this->Optimizer.Chosen[token].score < this->Optimizer.Chosen[owner].score)
        {
          owner = token;
        }
      });
  }
  for (int token = 0; token < count; ++token)
  {
    EdgeHypothesis& hypothesis = this->Optimizer.Chosen[token];
    const auto begin = this->Optimizer.Support.begin() + hypothesis.begin;
    const auto kept = std::remove_if(begin, begin + hypothesis.count,
      [&](const EdgeCandidate& candidate)
      { return this->Edges.Distance(owners[candidate.image][candidate.token], token) > neighbor; });
    hypothesis.count = static_cast<int>(kept - begin);
  }
}

// The options with the limit of the gradient in pixels of the longest baseline, which the steps measure
// disparities in, instead of the shortest.
MatcherOptions InPixelsOfTheLongest(
  const ImageEdges& reference, const std::vector<ImageEdges>& others, MatcherOptions options)
{
  constexpr double most = 4;
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
  for (const ImageEdges& other : others)
  {
    const double baseline = EpipolarPair(reference.camera, other.camera).Baseline;
    shortest = std::min(shortest, baseline);
    longest = std::max(longest, baseline);
  }
  options.gradientLimit *= shortest > 0 ? std::min(most, longest / shortest) : most;
  return options;
}

}

LargeVector<EdgeMatch> MatchEdges(const ImageEdges& reference,
  const std::vector<ImageEdges>& others, const MatcherOptions& options,
  LargeVector<EdgeCandidate>* support)
{
  options.Check();
  if (others.size() < 2)
  {
    throw Error("Trinocular matching needs three images.");
  }
  const MatcherOptions scaled = InPixelsOfTheLongest(reference, others, options);
  Matcher matcher(reference, others, scaled);
  LargeVector<EdgeMatch> matches = matcher.Match();
  if (support)
  {
    *support = matcher.TakeSupport();
  }
  return matches;
}

}
