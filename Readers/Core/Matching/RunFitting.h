// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_RunFitting_h
#define freespace_RunFitting_h

#include "Matching/EdgeHypothesis.h"
#include "Matching/EdgeMatch.h"
#include "Matching/MatcherOptions.h"

namespace freespace
{

/// How far the disparity goes from one token to the next, `step` pixels along the chain, in units
/// of what a continuous surface allows. Baseline: see EpipolarPair, of the longest pair.
inline double DisparityJump(const EdgeHypothesis& from, const EdgeHypothesis& to, double step,
  double baseline, const MatcherOptions& options)
{
  const double difference = to.disparity - from.disparity;
  const double slope = options.gradientLimit * step / baseline;
  const double error = options.tolerance * 0.75 * (from.sigma + to.sigma);
  return (difference < 0 ? -difference : difference) / (slope + error);
}

/// Makes matches of the hypotheses that were chosen along the reference's chains: the point nearest
/// to all edge lines gives the disparity, a chain is cut where the disparity jumps, and tokens
/// off the line through their neighbours and pieces that are too short are dropped. A token
/// without confirmation by a third image stays only where it closes a gap between two that have it.
/// One match per token.
LargeVector<EdgeMatch> MatchRuns(const EdgeChains& edges, LargeVector<EdgeHypothesis> chosen,
  const LargeVector<EdgeCandidate>& support, double baseline, const MatcherOptions& options);

}

#endif
