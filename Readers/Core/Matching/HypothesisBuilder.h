// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_HypothesisBuilder_h
#define freespace_HypothesisBuilder_h

#include "Matching/CandidateSearch.h"
#include "Matching/DisparityPrior.h"
#include "Matching/EdgeHypothesis.h"

#include <memory>
#include <utility>
#include <vector>

namespace freespace
{

/// The hypotheses of a token are the states begin .. end - 1 of its chain; the best comes first,
/// "no match" last.
struct TokenStates
{
  int begin = 0, end = 0;
};

/// Groups the candidates of a token to hypotheses: the third image's confirmation, the second step
/// of trinocular matching (see MatchEdges).
class HypothesisBuilder
{
public:
  /// Keeps references to all three; takes the candidates from the search.
  HypothesisBuilder(
    const EdgeChains& edges, CandidateSearch& search, const MatcherOptions& options);

  /// Sets the prior of the disparity around a token; null: none.
  void SetPrior(std::unique_ptr<DisparityPrior> prior) { this->Prior = std::move(prior); }

  /// Appends the best hypotheses of a token, made of its candidates, and "no match" to the states of
  /// the chain.
  TokenStates FindHypotheses(int token);

  /// The hypotheses of the tokens of one chain and their support.
  std::vector<EdgeHypothesis> States;
  std::vector<EdgeCandidate> Support;

private:
  void Confirm(const EdgeCandidate& seed, std::size_t begin, std::size_t end);
  void ApplyPrior(int token);
  void KeepBest();

  const EdgeChains& Edges; // of the reference
  CandidateSearch& Search;
  const MatcherOptions& Options;
  std::unique_ptr<DisparityPrior> Prior; // none in the first round

  // Of one token.
  std::vector<EdgeHypothesis> Found;
  std::vector<std::pair<double, int>> Order;  // of the hypotheses found, by score
  std::vector<const EdgeCandidate*> Agreeing; // per image
  std::vector<float> AgreeingCost;
};

}

#endif
