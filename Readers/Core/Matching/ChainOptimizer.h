// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ChainOptimizer_h
#define freespace_ChainOptimizer_h

#include "Edges/LargeVector.h"
#include "Matching/CandidateSearch.h"
#include "Matching/EdgeHypothesis.h"
#include "Matching/HypothesisBuilder.h"

#include <memory>
#include <vector>

namespace freespace
{

/// Chooses one hypothesis per token of a chain by dynamic programming: the third step of trinocular
/// matching (see MatchEdges). It also decides which tokens search their epipolar lines and which
/// follow the matches of their neighbours.
class ChainOptimizer
{
public:
  /// Keeps references to the reference image and the options.
  ChainOptimizer(const ImageEdges& reference, const std::vector<ImageEdges>& others,
    const MatcherOptions& options);

  ChainOptimizer(const ChainOptimizer&) = delete;
  ChainOptimizer& operator=(const ChainOptimizer&) = delete;

  /// See HypothesisBuilder.
  void SetPrior(std::unique_ptr<DisparityPrior> prior) { this->Builder.SetPrior(std::move(prior)); }

  /// Chooses the hypotheses of the tokens begin .. end - 1, which are one chain, so that the sum of
  /// the scores and of the transition costs is minimal. Returns whether another match would have
  /// been about as good for most of the tokens.
  bool ChooseAlongChain(int begin, int end);

  const CandidateSearch& Images() const { return this->Search; }

  /// The result: one hypothesis per token, and their support.
  LargeVector<EdgeHypothesis> Chosen;
  LargeVector<EdgeCandidate> Support;

private:
  void FindHypothesesAlongChain(int begin, int end);
  void SearchFrom(int token, const TokenStates& neighbor);
  bool ContinuesEverywhere(const EdgeHypothesis& best);
  void AddLeads(const TokenStates& states);
  double Transition(const EdgeHypothesis& from, const EdgeHypothesis& to, double step) const;
  bool HasRival(int chosen, int first) const;
  void Choose(int token, const EdgeHypothesis& hypothesis);

  const EdgeChains& Edges; // of the reference
  const MatcherOptions& Options;
  CandidateSearch Search;
  HypothesisBuilder Builder;

  // Of one chain.
  int FirstToken = 0;
  int LastSearched = 0; // the last token that searched all its lines
  std::vector<TokenStates> TokenStatesOf;
  std::vector<double> StateCost; // of the best path to each state
  std::vector<int> StateFrom;    // and the state before it on that path
  // Of one token.
  std::vector<char> Continued; // per image: a good match continues there
};

}

#endif
