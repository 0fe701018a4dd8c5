// SPDX-License-Identifier: BSD-3-Clause
#include "Matching/ChainOptimizer.h"

#include "Matching/RunFitting.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace freespace
{

ChainOptimizer::ChainOptimizer(
  const ImageEdges& reference, const std::vector<ImageEdges>& others, const MatcherOptions& options)
  : Edges(reference.edges)
  , Options(options)
  , Search(reference, others, options)
  , Builder(reference.edges, this->Search, options)
  , Continued(others.size())
{
  this->Chosen.resize(this->Edges.tokens.size());
  this->Support.reserve(this->Search.NumberOfImages() * this->Edges.tokens.size());
}

bool ChainOptimizer::ChooseAlongChain(int begin, int end)
{
  this->Builder.States.clear();
  this->Builder.Support.clear();
  this->FindHypothesesAlongChain(begin, end);
  std::vector<double>& cost = this->StateCost;
  std::vector<int>& from = this->StateFrom;
  cost.resize(this->Builder.States.size());
  from.resize(this->Builder.States.size());
  TokenStates before;
  for (int token = begin; token < end; ++token)
  {
    const TokenStates states = this->TokenStatesOf[token - begin];
    const double step = token > begin ? this->Edges.Distance(token - 1, token) : 0;
    for (int s = states.begin; s < states.end; ++s)
    {
      double best = token > begin ? std::numeric_limits<double>::infinity() : 0;
      int bestFrom = -1;
      for (int p = before.begin; p < before.end; ++p)
      {
        if (cost[p] >= best) // no transition cost is negative
        {
          continue;
        }
        const double sum =
          cost[p] + this->Transition(this->Builder.States[p], this->Builder.States[s], step);
        if (sum < best)
        {
          best = sum;
          bestFrom = p;
        }
      }
      cost[s] = best + this->Builder.States[s].score;
      from[s] = bestFrom;
    }
    before = states;
  }
  int state = static_cast<int>(
    std::min_element(cost.begin() + before.begin, cost.begin() + before.end) - cost.begin());
  int matched = 0, ambiguous = 0;
  for (int token = end - 1; token >= begin; --token)
  {
    matched += this->Builder.States[state].Confirmed();
    ambiguous += this->HasRival(state, this->TokenStatesOf[token - begin].begin);
    this->Choose(token, this->Builder.States[state]);
    state = from[state];
  }
  return 2 * ambiguous > matched;
}

// Finds the hypotheses of all tokens of a chain. A match continues over several tokens: every fourth
// token searches its epipolar lines, those between follow its candidates along the edges of the
// other images.
void ChainOptimizer::FindHypothesesAlongChain(int begin, int end)
{
  const int stride = std::clamp(this->Options.minimumRun, 1, 4);
  this->TokenStatesOf.resize(end - begin);
  this->Search.FindRays(begin, end);
  this->FirstToken = begin;
  this->LastSearched = begin;
  this->SearchFrom(begin, TokenStates());
  for (int last = begin; last + 1 < end;)
  {
    const int next = std::min(last + stride, end - 1);
    this->SearchFrom(next, this->TokenStatesOf[last - begin]);
    this->AddLeads(this->TokenStatesOf[next - begin]); // beside those of the last one
    for (int token = last + 1; token < next; ++token)
    {
      this->Search.Candidates.clear();
      this->Search.FindLines(token);
      this->Search.FollowLeads(token);
      this->TokenStatesOf[token - begin] = this->Builder.FindHypotheses(token);
    }
    last = next;
  }
}

// Finds the hypotheses of a token: those to which its neighbour leads and, where these are not good
// enough, others along the epipolar lines.
void ChainOptimizer::SearchFrom(int token, const TokenStates& neighbor)
{
  TokenStates& states = this->TokenStatesOf[token - this->FirstToken];
  this->Search.Candidates.clear();
  this->Search.ClearLeads();
  this->AddLeads(neighbor);
  const int usable = this->Search.FindLines(token);
  this->Search.FollowLeads(token);
  if (usable < 2) // one image confirms nothing
  {
    states = this->Builder.FindHypotheses(token);
    return;
  }
  std::fill(this->Continued.begin(), this->Continued.end(), 0);
  constexpr int longest = 32; // without a search, tokens
  if (!this->Search.Candidates.empty() && token - this->LastSearched < longest)
  {
    const std::size_t support = this->Builder.Support.size();
    states = this->Builder.FindHypotheses(token);
    if (this->ContinuesEverywhere(this->Builder.States[states.begin]))
    {
      return;
    }
    this->Builder.States.resize(states.begin);
    this->Builder.Support.resize(support);
  }
  if (std::find(this->Continued.begin(), this->Continued.end(), 1) == this->Continued.end())
  {
    this->LastSearched = token;
  }
  this->Search.FindCandidates(token, this->Continued);
  states = this->Builder.FindHypotheses(token);
}

// Whether a hypothesis is confirmed and looks right in all images that may show it; marks the images
// where it does.
bool ChainOptimizer::ContinuesEverywhere(const EdgeHypothesis& best)
{
  constexpr double good = 0.12; // mean cost
  if (!best.Confirmed() || best.score > (good - 1) * best.count)
  {
    return false;
  }
  for (int k = best.begin; k < best.begin + best.count; ++k)
  {
    this->Continued[this->Builder.Support[k].image] = 1;
  }
  bool everywhere = true;
  for (std::size_t image = 0; image < this->Search.NumberOfImages(); ++image)
  {
    everywhere = everywhere && (this->Continued[image] || !this->Search.IsUsable(image));
  }
  return everywhere;
}

// Adds the support of a neighbour's hypotheses to the leads.
void ChainOptimizer::AddLeads(const TokenStates& states)
{
  constexpr float margin = 1.0f; // a state worse by more is not chosen along the chain
  for (int s = states.begin; s < states.end; ++s)
  {
    const EdgeHypothesis& state = this->Builder.States[s];
    if (state.score > this->Builder.States[states.begin].score + margin)
    {
      break; // the best come first
    }
    for (int k = state.begin; k < state.begin + state.count && state.promising; ++k)
    {
      this->Search.AddLead(this->Builder.Support[k]);
    }
  }
}

// The cost of going from one state to the next along a chain.
double ChainOptimizer::Transition(
  const EdgeHypothesis& from, const EdgeHypothesis& to, double step) const
{
  constexpr double weight = 0.5, breakCost = 1.5, beginOrEnd = 0.3;
  if (from.Empty() || to.Empty())
  {
    return from.Empty() == to.Empty() ? 0 : beginOrEnd;
  }
  return std::min(breakCost,
    weight * DisparityJump(from, to, step, this->Search.LongestBaseline(), this->Options));
}

// Whether a token whose states begin at `first` has another one about as good as the one chosen.
bool ChainOptimizer::HasRival(int chosen, int first) const
{
  constexpr double margin = 0.3;
  for (int s = first; !this->Builder.States[s].Empty() && this->Builder.States[chosen].Confirmed();
       ++s)
  {
    if (s != chosen && this->Builder.States[s].Confirmed() &&
      this->Builder.States[s].score < this->Builder.States[chosen].score + margin)
    {
      return true;
    }
  }
  return false;
}

void ChainOptimizer::Choose(int token, const EdgeHypothesis& hypothesis)
{
  this->Chosen[token] = hypothesis;
  this->Chosen[token].begin = static_cast<int>(this->Support.size());
  this->Support.insert(this->Support.end(), this->Builder.Support.begin() + hypothesis.begin,
    this->Builder.Support.begin() + hypothesis.begin + hypothesis.count);
}

}
