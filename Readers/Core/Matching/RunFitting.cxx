// SPDX-License-Identifier: BSD-3-Clause
#include "Matching/RunFitting.h"

#include "Common/Median.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

namespace
{

constexpr double LongestGap = 12;   // within a run, pixels
constexpr double LeastNoise = 0.05; // of an edge's place, pixels

class RunMatcher
{
public:
  RunMatcher(const EdgeChains& edges, LargeVector<EdgeHypothesis>& chosen,
    const LargeVector<EdgeCandidate>& support, double baseline, const MatcherOptions& options)
    : Edges(edges)
    , Chosen(chosen)
    , Support(support)
    , Baseline(baseline)
    , Options(options)
    , Matches(edges.tokens.size())
    , Residual(edges.tokens.size(), 0.0)
  {
  }

  LargeVector<EdgeMatch> Match()
  {
    for (EdgeHypothesis& hypothesis : this->Chosen)
    {
      if (!hypothesis.Empty())
      {
        this->Intersect(hypothesis);
      }
    }
    std::vector<std::vector<int>> runs;
    for (std::size_t chain = 0; chain < this->Edges.NumberOfChains(); ++chain)
    {
      this->SplitIntoRuns(this->Edges.begin[chain], this->Edges.begin[chain + 1], runs);
    }
    for (std::vector<int>& run : runs)
    {
      this->DropUnconfirmed(run);
      this->FitRun(run);
    }
    const double noise = this->MedianResidual(runs);
    const double limit = this->ResidualLimit(noise);
    for (const std::vector<int>& run : runs)
    {
      this->MatchRun(run, limit);
    }
    this->ScaleDeviations(std::max(LeastNoise, noise));
    return std::move(this->Matches);
  }

private:
  struct Fitted
  {
    double disparity, deviation;
  };

  // The point nearest to all edge lines. The unknowns are the disparity and the token's shift across
  // the edge in the reference image.
  void Intersect(EdgeHypothesis& hypothesis) const
  {
    double a = 0, b = 0, c = 1; // normal matrix; the reference's own line asks for shift = 0
    double right = 0, rightShift = 0;
    for (int k = hypothesis.begin; k < hypothesis.begin + hypothesis.count; ++k)
    {
      const EdgeCandidate& candidate = this->Support[k];
      const double weight = candidate.Weight();
      a += weight;
      b -= weight * candidate.shift;
      c += weight * candidate.shift * candidate.shift;
      right += weight * candidate.disparity;
      rightShift -= weight * candidate.shift * candidate.disparity;
    }
    const double determinant = a * c - b * b;
    hypothesis.disparity = (c * right - b * rightShift) / determinant;
    hypothesis.sigma = static_cast<float>(std::sqrt(c / determinant));
  }

  // The shift across the edge that fits all lines best for a given disparity.
  double BestShift(const EdgeHypothesis& hypothesis, double disparity) const
  {
    double weights = 1, sum = 0;
    for (int k = hypothesis.begin; k < hypothesis.begin + hypothesis.count; ++k)
    {
      const EdgeCandidate& candidate = this->Support[k];
      const double weight = candidate.shift * candidate.Weight();
      weights += weight * candidate.shift;
      sum += weight * (disparity - candidate.disparity);
    }
    return sum / weights;
  }

  // Splits the tokens [begin, end) of a chain that have a hypothesis where the disparity jumps.
  void SplitIntoRuns(int begin, int end, std::vector<std::vector<int>>& runs) const
  {
    const std::size_t before = runs.size();
    for (int i = begin; i < end; ++i)
    {
      if (this->Chosen[i].Empty())
      {
        continue;
      }
      bool continues = runs.size() > before;
      if (continues)
      {
        const int last = runs.back().back();
        const double step = this->Edges.Distance(last, i);
        continues = step <= LongestGap &&
          DisparityJump(this->Chosen[last], this->Chosen[i], step, this->Baseline, this->Options) <=
            1;
      }
      if (!continues)
      {
        runs.emplace_back();
      }
      runs.back().push_back(i);
    }
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

  // The disparity of the k-th token of a run by a line through its neighbours: as many of them as are
  // needed for an error of a good third of a pixel of the longest baseline.
  // Its deviation is that where the edges are off by one pixel across.
  Fitted FitDisparity(int k) const
  {
    constexpr int leastRadius = 2, greatestRadius = 12;
    const double enough = std::pow(this->Baseline / 0.35, 2);
    const std::vector<Sample>& samples = this->Samples;
    const int last = static_cast<int>(samples.size()) - 1;
    double w = 0, ws = 0, wss = 0, wd = 0, wsd = 0;
    const auto add = [&](int j)
    {
      const Sample& sample = samples[j];
      const double distance = (sample.position - samples[k].position).norm();
      const double s = j < k ? -distance : distance;
      w += sample.weight;
      ws += sample.weight * s;
      wss += sample.weight * s * s;
      wd += sample.weight * sample.disparity;
      wsd += sample.weight * s * sample.disparity;
    };
    add(k);
    for (int radius = 1; radius <= greatestRadius && (radius <= leastRadius || w < enough);
         ++radius)
    {
      if (k - radius >= 0)
      {
        add(k - radius);
      }
      if (k + radius <= last)
      {
        add(k + radius);
      }
    }
    const double determinant = w * wss - ws * ws;
    return determinant > 0
      ? Fitted{ (wd * wss - wsd * ws) / determinant, std::sqrt(wss / determinant) }
      : Fitted{ wd / w, std::sqrt(1 / w) };
  }

  // Computes the fitted disparities of a run and the residuals of its edges.
  void FitRun(const std::vector<int>& run)
  {
    this->Samples.clear();
    for (int i : run)
    {
      const EdgeHypothesis& hypothesis = this->Chosen[i];
      this->Samples.push_back(
        { this->Edges.tokens[i].position, hypothesis.disparity, hypothesis.Weight() });
    }
    for (int k = 0; k < static_cast<int>(run.size()); ++k)
    {
      const EdgeHypothesis& hypothesis = this->Chosen[run[k]];
      const auto [disparity, deviation] = this->FitDisparity(k);
      double residual = std::abs(hypothesis.disparity - disparity) / hypothesis.sigma;
      for (int j = hypothesis.begin; j < hypothesis.begin + hypothesis.count; ++j)
      {
        const EdgeCandidate& candidate = this->Support[j];
        residual = std::max(residual, std::abs(candidate.disparity - disparity) / candidate.sigma);
      }
      this->Matches[run[k]].disparity = disparity;
      this->Matches[run[k]].deviation = deviation;
      this->Residual[run[k]] = residual;
    }
  }

  // Of all images' edges, pixels.
  double MedianResidual(const std::vector<std::vector<int>>& runs) const
  {
    std::vector<double> residuals;
    for (const std::vector<int>& run : runs)
    {
      for (int i : run)
      {
        residuals.push_back(this->Residual[i]);
      }
    }
    return MedianOr(std::move(residuals), 0.0);
  }

  // From deviations where edges are off by a pixel. What the neighbours of a token have in common, such as
  // the way in which pixels sample an edge that follows their rows, is not averaged out by a line through them.
  void ScaleDeviations(double noise)
  {
    constexpr double perToken = 2, common = 0.12;
    for (std::size_t i = 0; i < this->Matches.size(); ++i)
    {
      EdgeMatch& match = this->Matches[i];
      if (match.images > 0)
      {
        match.deviation =
          std::hypot(perToken * noise * match.deviation, common * this->Chosen[i].sigma);
      }
    }
  }

  // Several times the median residual of these images, but not more than the tolerance. With sharp
  // images and exact cameras a wrong match is off by only a fraction of a pixel.
  double ResidualLimit(double median) const
  {
    constexpr double factor = 5, least = 0.2; // pixels
    return std::min(this->Options.tolerance, std::max(least, factor * median));
  }

  // An edge nearly parallel to the epipolar line magnifies the error of its disparity. It has to fit
  // better, so that its disparity is within the limit as well (in pixels of the longest baseline).
  double LimitOf(const EdgeHypothesis& hypothesis, double limit) const
  {
    return limit * std::min(1.0, 1 / (hypothesis.sigma * this->Baseline));
  }

  // Turns the tokens that fit into matches, in pieces without a gap.
  void MatchRun(const std::vector<int>& run, double limit)
  {
    std::vector<int> piece;
    for (int i : run)
    {
      const EdgeHypothesis& hypothesis = this->Chosen[i];
      const bool fits = this->Residual[i] <= this->LimitOf(hypothesis, limit) &&
        this->Matches[i].disparity > 0 && this->MeanCost(hypothesis) <= this->Options.maximumCost;
      if (!fits)
      {
        this->Matches[i] = EdgeMatch();
        continue;
      }
      if (!piece.empty() && this->Edges.Distance(piece.back(), i) > LongestGap)
      {
        this->FinishPiece(piece);
      }
      piece.push_back(i);
    }
    this->FinishPiece(piece);
  }

  void FinishPiece(std::vector<int>& piece)
  {
    const bool enough = static_cast<int>(piece.size()) >= this->Options.minimumRun;
    for (int i : piece)
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
    piece.clear();
  }

  double MeanCost(const EdgeHypothesis& hypothesis) const
  {
    double cost = 0;
    for (int k = hypothesis.begin; k < hypothesis.begin + hypothesis.count; ++k)
    {
      cost += this->Support[k].cost / hypothesis.count;
    }
    return cost;
  }

  void FillMatch(int i)
  {
    const EdgeHypothesis& hypothesis = this->Chosen[i];
    const EdgeToken& token = this->Edges.tokens[i];
    EdgeMatch& match = this->Matches[i];
    match.images = hypothesis.count;
    match.support = hypothesis.begin;
    match.imagePoint =
      token.position + this->BestShift(hypothesis, match.disparity) * token.Normal();
    match.cost = this->MeanCost(hypothesis);
    match.run = this->NumberOfRuns;
  }

  const EdgeChains& Edges;
  LargeVector<EdgeHypothesis>& Chosen;
  const LargeVector<EdgeCandidate>& Support;
  double Baseline;
  const MatcherOptions& Options;
  LargeVector<EdgeMatch> Matches;
  std::vector<double> Residual; // per token, pixels across the edge
  int NumberOfRuns = 0;

  // The tokens of the current run, to which a line is fitted.
  struct Sample
  {
    Eigen::Vector2d position;
    double disparity, weight;
  };
  std::vector<Sample> Samples;
};

}

LargeVector<EdgeMatch> MatchRuns(const EdgeChains& edges, LargeVector<EdgeHypothesis> chosen,
  const LargeVector<EdgeCandidate>& support, double baseline, const MatcherOptions& options)
{
  return RunMatcher(edges, chosen, support, baseline, options).Match();
}

}
