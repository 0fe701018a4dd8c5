// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeRuns.h"

#include <cmath>

namespace freespace
{

namespace
{

class RunMatcher
{
public:
  RunMatcher(const EdgeChains& edges, std::vector<EdgeHypothesis>& chosen,
    const std::vector<EdgeCandidate>& support, double baseline, const MatcherOptions& options)
    : Edges(edges)
    , Chosen(chosen)
    , Support(support)
    , Baseline(baseline)
    , Options(options)
    , Matches(edges.tokens.size())
  {
  }

  std::vector<EdgeMatch> Match()
  {
    for (EdgeHypothesis& hypothesis : this->Chosen)
    {
      if (!hypothesis.Empty())
      {
        this->Intersect(hypothesis);
      }
    }
    for (std::size_t chain = 0; chain < this->Edges.NumberOfChains(); ++chain)
    {
      for (std::vector<int>& run :
        this->SplitIntoRuns(this->Edges.begin[chain], this->Edges.begin[chain + 1]))
      {
        this->DropUnconfirmed(run);
        this->MatchRun(run);
      }
    }
    return std::move(this->Matches);
  }

private:
  // The point nearest to all edge lines: unknown are the disparity and the token's shift across the
  // edge in the reference image.
  void Intersect(EdgeHypothesis& hypothesis) const
  {
    double a = 0, b = 0, c = 1; // normal matrix; the reference's own line asks for shift = 0
    double right = 0, rightShift = 0;
    for (int k = hypothesis.begin; k < hypothesis.begin + hypothesis.count; ++k)
    {
      const EdgeCandidate& candidate = this->Support[k];
      const double weight = 1 / (candidate.sigma * candidate.sigma);
      a += weight;
      b -= weight * candidate.shift;
      c += weight * candidate.shift * candidate.shift;
      right += weight * candidate.disparity;
      rightShift -= weight * candidate.shift * candidate.disparity;
    }
    const double determinant = a * c - b * b;
    hypothesis.disparity = (c * right - b * rightShift) / determinant;
    hypothesis.sigma = std::sqrt(c / determinant);
  }

  // With the disparity given, the shift across the edge that fits all lines best.
  double BestShift(const EdgeHypothesis& hypothesis, double disparity) const
  {
    double weights = 1, sum = 0;
    for (int k = hypothesis.begin; k < hypothesis.begin + hypothesis.count; ++k)
    {
      const EdgeCandidate& candidate = this->Support[k];
      const double weight = candidate.shift / (candidate.sigma * candidate.sigma);
      weights += weight * candidate.shift;
      sum += weight * (disparity - candidate.disparity);
    }
    return sum / weights;
  }

  double Step(int from, int to) const
  {
    return (this->Edges.tokens[to].position - this->Edges.tokens[from].position).norm();
  }

  // The tokens [begin, end) of a chain that have a hypothesis, in pieces without a jump.
  std::vector<std::vector<int>> SplitIntoRuns(int begin, int end) const
  {
    constexpr double gap = 8; // pixels
    std::vector<std::vector<int>> runs;
    for (int i = begin; i < end; ++i)
    {
      if (this->Chosen[i].Empty())
      {
        continue;
      }
      bool continues = !runs.empty();
      if (continues)
      {
        const int last = runs.back().back();
        const double step = this->Step(last, i);
        continues = step <= gap &&
          DisparityJump(this->Chosen[last], this->Chosen[i], step, this->Baseline, this->Options) <=
            1;
      }
      if (!continues)
      {
        runs.emplace_back();
      }
      runs.back().push_back(i);
    }
    return runs;
  }

  void DropUnconfirmed(std::vector<int>& run) const
  {
    constexpr int longestGap = 12; // tokens
    std::vector<int> kept;
    int last = -1; // position in the run of the last confirmed token
    for (int k = 0; k < static_cast<int>(run.size()); ++k)
    {
      if (!this->Chosen[run[k]].Confirmed())
      {
        continue;
      }
      if (last >= 0 && k - last <= longestGap)
      {
        kept.insert(kept.end(), run.begin() + last + 1, run.begin() + k);
      }
      kept.push_back(run[k]);
      last = k;
    }
    run = std::move(kept);
  }

  // The disparity of a run's k-th token by a line through its neighbours: as many of them as make
  // it known to a good third of a pixel of the longest baseline.
  double FitDisparity(const std::vector<int>& run, int k) const
  {
    constexpr int leastRadius = 2, greatestRadius = 12;
    const double enough = std::pow(this->Baseline / 0.35, 2);
    double w = 0, ws = 0, wss = 0, wd = 0, wsd = 0;
    const auto add = [&](int j)
    {
      const EdgeHypothesis& hypothesis = this->Chosen[run[j]];
      const double weight = 1 / (hypothesis.sigma * hypothesis.sigma);
      const double s = (j < k ? -1 : 1) * this->Step(run[k], run[j]);
      w += weight;
      ws += weight * s;
      wss += weight * s * s;
      wd += weight * hypothesis.disparity;
      wsd += weight * s * hypothesis.disparity;
    };
    add(k);
    for (int radius = 1; radius <= greatestRadius && (radius <= leastRadius || w < enough);
         ++radius)
    {
      if (k - radius >= 0)
      {
        add(k - radius);
      }
      if (k + radius < static_cast<int>(run.size()))
      {
        add(k + radius);
      }
    }
    const double determinant = w * wss - ws * ws;
    return determinant > 0 ? (wd * wss - wsd * ws) / determinant : wd / w;
  }

  void MatchRun(const std::vector<int>& run)
  {
    std::vector<int> kept;
    for (int k = 0; k < static_cast<int>(run.size()); ++k)
    {
      const EdgeHypothesis& hypothesis = this->Chosen[run[k]];
      const double disparity = this->FitDisparity(run, k);
      const double off = std::abs(hypothesis.disparity - disparity);
      if (disparity > 0 && off <= this->Options.tolerance * hypothesis.sigma)
      {
        kept.push_back(run[k]);
        this->Matches[run[k]].disparity = disparity;
      }
    }
    const bool enough = static_cast<int>(kept.size()) >= this->Options.minimumRun;
    for (int i : kept)
    {
      if (enough)
      {
        this->FillMatch(i);
      }
      else
      {
        this->Matches[i] = EdgeMatch();
      }
    }
    this->NumberOfRuns += enough;
  }

  void FillMatch(int i)
  {
    const EdgeHypothesis& hypothesis = this->Chosen[i];
    const EdgeToken& token = this->Edges.tokens[i];
    EdgeMatch& match = this->Matches[i];
    match.images = hypothesis.count;
    match.imagePoint =
      token.position + this->BestShift(hypothesis, match.disparity) * token.Normal();
    for (int k = hypothesis.begin; k < hypothesis.begin + hypothesis.count; ++k)
    {
      match.cost += this->Support[k].cost / hypothesis.count;
    }
    match.run = this->NumberOfRuns;
  }

  const EdgeChains& Edges;
  std::vector<EdgeHypothesis>& Chosen;
  const std::vector<EdgeCandidate>& Support;
  double Baseline;
  const MatcherOptions& Options;
  std::vector<EdgeMatch> Matches;
  int NumberOfRuns = 0;
};

}

std::vector<EdgeMatch> MatchRuns(const EdgeChains& edges, std::vector<EdgeHypothesis> chosen,
  const std::vector<EdgeCandidate>& support, double baseline, const MatcherOptions& options)
{
  return RunMatcher(edges, chosen, support, baseline, options).Match();
}

}
