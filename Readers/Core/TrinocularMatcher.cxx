// SPDX-License-Identifier: BSD-3-Clause
#include "TrinocularMatcher.h"

#include "EpipolarPair.h"
#include "Error.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace freespace
{

namespace
{

constexpr int MaximumHypotheses = 8; // per token

double Radians(double degrees)
{
  return degrees * 3.14159265358979323846 / 180;
}

// Brings one image's colours to the mean and spread of the reference's, channel by channel: the
// pictures of a cluster show about the same, but perhaps under another exposure.
class ColorTransfer
{
public:
  ColorTransfer(const EdgeChains& from, const EdgeChains& to)
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      const auto [fromMean, fromSpread] = Statistics(from, channel);
      const auto [toMean, toSpread] = Statistics(to, channel);
      const double gain = std::clamp(toSpread / std::max(fromSpread, 1.0), 0.25, 4.0);
      for (int value = 0; value < 256; ++value)
      {
        const double color = toMean + gain * (value - fromMean);
        this->Table[channel][value] = static_cast<std::uint8_t>(std::clamp(color, 0.0, 255.0));
      }
    }
  }

  EdgeSide operator()(EdgeSide side) const
  {
    for (std::size_t i = 0; i < side.size(); ++i)
    {
      side[i] = this->Table[i % 3][side[i]];
    }
    return side;
  }

private:
  static std::pair<double, double> Statistics(const EdgeChains& edges, int channel)
  {
    double sum = 0, squares = 0, count = 0;
    for (const EdgeToken& token : edges.tokens)
    {
      for (const EdgeSide* side : { &token.bright, &token.dark })
      {
        for (std::size_t i = channel; i < side->size(); i += 3)
        {
          sum += (*side)[i];
          squares += static_cast<double>((*side)[i]) * (*side)[i];
          ++count;
        }
      }
    }
    const double mean = count > 0 ? sum / count : 0;
    return { mean, count > 0 ? std::sqrt(std::max(0.0, squares / count - mean * mean)) : 0 };
  }

  std::uint8_t Table[3][256];
};

double MeanDifference(const EdgeSide& a, const EdgeSide& b)
{
  int sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += std::abs(static_cast<int>(a[i]) - static_cast<int>(b[i]));
  }
  return static_cast<double>(sum) / a.size();
}

// A piece of a chain of another image in the pair's rectified frame, from one token to the next.
struct Segment
{
  float u, v;      // where it starts
  float slope;     // du / dv
  float low, high; // rows between which it lies
  float tangentU, tangentV;
  int token;
};

// The chains of another image, sorted by the rows of the rectified frame.
class EpipolarIndex
{
public:
  EpipolarIndex(const ImageEdges& reference, const ImageEdges& other, double minimumSine)
    : Pair(reference.camera, other.camera)
  {
    this->AddSegments(other.edges, minimumSine);
    this->SortIntoRows();
    const ColorTransfer transfer(other.edges, reference.edges);
    this->Sides.reserve(other.edges.tokens.size());
    for (const EdgeToken& token : other.edges.tokens)
    {
      this->Sides.push_back({ transfer(token.bright), transfer(token.dark) });
    }
  }

  // Calls visit(segment) for all that cross row v.
  template <typename Visitor>
  void VisitRow(double v, Visitor&& visit) const
  {
    const double row = std::floor(v) - this->FirstRow;
    if (!(row >= 0) || row + 1 >= static_cast<double>(this->Begin.size()))
    {
      return;
    }
    const std::size_t r = static_cast<std::size_t>(row);
    for (int i = this->Begin[r]; i < this->Begin[r + 1]; ++i)
    {
      const Segment& segment = this->Segments[this->Members[i]];
      if (segment.low <= v && v < segment.high)
      {
        visit(segment);
      }
    }
  }

  EpipolarPair Pair;
  std::vector<std::array<EdgeSide, 2>> Sides; // per token: bright, dark

private:
  void AddSegments(const EdgeChains& edges, double minimumSine)
  {
    std::vector<EpipolarPair::Ray> rays;
    rays.reserve(edges.tokens.size());
    for (const EdgeToken& token : edges.tokens)
    {
      rays.push_back(this->Pair.FromOther(token.position));
    }
    for (std::size_t chain = 0; chain < edges.NumberOfChains(); ++chain)
    {
      for (int i = edges.begin[chain]; i + 1 < edges.begin[chain + 1]; ++i)
      {
        const EpipolarPair::Ray &a = rays[i], &b = rays[i + 1];
        if (!(a.scale > 0) || !(b.scale > 0) || a.v == b.v)
        {
          continue;
        }
        const EdgeToken& token = edges.tokens[i];
        const Eigen::Vector2d tangent =
          (this->Pair.OtherJacobian(token.position) * token.tangent).normalized();
        if (std::abs(tangent.y()) >= minimumSine)
        {
          this->Segments.push_back({ static_cast<float>(a.u), static_cast<float>(a.v),
            static_cast<float>((b.u - a.u) / (b.v - a.v)), static_cast<float>(std::min(a.v, b.v)),
            static_cast<float>(std::max(a.v, b.v)), static_cast<float>(tangent.x()),
            static_cast<float>(tangent.y()), i });
        }
      }
    }
  }

  void SortIntoRows()
  {
    if (this->Segments.empty())
    {
      return;
    }
    double low = this->Segments[0].low, high = this->Segments[0].high;
    for (const Segment& segment : this->Segments)
    {
      low = std::min<double>(low, segment.low);
      high = std::max<double>(high, segment.high);
    }
    this->FirstRow = std::floor(low);
    const auto rowOf = [this](float v) { return static_cast<int>(std::floor(v) - this->FirstRow); };
    this->Begin.assign(rowOf(static_cast<float>(high)) + 2, 0);
    for (const Segment& segment : this->Segments)
    {
      for (int row = rowOf(segment.low); row <= rowOf(segment.high); ++row)
      {
        ++this->Begin[row + 1];
      }
    }
    for (std::size_t row = 1; row < this->Begin.size(); ++row)
    {
      this->Begin[row] += this->Begin[row - 1];
    }
    this->Members.resize(this->Begin.back());
    std::vector<int> next(this->Begin.begin(), this->Begin.end() - 1);
    for (int i = 0; i < static_cast<int>(this->Segments.size()); ++i)
    {
      for (int row = rowOf(this->Segments[i].low); row <= rowOf(this->Segments[i].high); ++row)
      {
        this->Members[next[row]++] = i;
      }
    }
  }

  std::vector<Segment> Segments;
  std::vector<int> Members;
  std::vector<int> Begin;
  double FirstRow = 0;
};

// A token of another image that may show the same edge.
struct Candidate
{
  double disparity;
  double sigma; // error of the disparity when the edge is off by one pixel across
  double shift; // change of the disparity when the reference's token moves one pixel across
  double cost;  // [0, 1]
  int image;
  int token;
};

// Candidates that confirm each other.
struct Hypothesis
{
  double disparity = 0;
  double score = 0; // the lower the better
  std::vector<Candidate> support;
};

class Matcher
{
public:
  Matcher(const ImageEdges& reference, const std::vector<ImageEdges>& others,
    const MatcherOptions& options)
    : Reference(reference)
    , Options(options)
    , MinimumSine(std::sin(Radians(options.minimumAngle)))
  {
    for (const ImageEdges& other : others)
    {
      this->Indices.emplace_back(reference, other, this->MinimumSine);
      this->Baseline = std::max(this->Baseline, this->Indices.back().Pair.Baseline);
    }
  }

  std::vector<EdgeMatch> Run()
  {
    const EdgeChains& edges = this->Reference.edges;
    std::vector<Hypothesis> chosen(edges.tokens.size());
    for (std::size_t chain = 0; chain < edges.NumberOfChains(); ++chain)
    {
      this->ChooseAlongChain(edges.begin[chain], edges.begin[chain + 1], chosen);
    }
    this->EnforceUniqueness(chosen);
    std::vector<EdgeMatch> matches(edges.tokens.size());
    for (std::size_t chain = 0; chain < edges.NumberOfChains(); ++chain)
    {
      this->KeepLongRuns(edges.begin[chain], edges.begin[chain + 1], chosen, matches);
    }
    return matches;
  }

private:
  // The edges on the token's epipolar line in one image.
  void FindCandidates(const EdgeToken& token, int image, std::vector<Candidate>& candidates) const
  {
    const EpipolarIndex& index = this->Indices[image];
    const EpipolarPair& pair = index.Pair;
    const EpipolarPair::Ray ray = pair.FromReference(token.position);
    if (!(ray.scale > 0))
    {
      return;
    }
    const Eigen::Matrix2d jacobian = pair.ReferenceJacobian(token.position);
    const Eigen::Vector2d tangent = (jacobian * token.tangent).normalized();
    if (std::abs(tangent.y()) < this->MinimumSine)
    {
      return;
    }
    const Eigen::Vector2d across = jacobian * token.Normal();
    const double cosine = std::cos(Radians(this->Options.angleTolerance));
    const double perColumn = ray.scale / pair.Baseline;
    index.VisitRow(ray.v,
      [&](const Segment& segment)
      {
        const double alignment = tangent.x() * segment.tangentU + tangent.y() * segment.tangentV;
        if (alignment < cosine)
        {
          return;
        }
        const double disparity =
          pair.Disparity(ray, segment.u + (ray.v - segment.v) * segment.slope);
        if (!(disparity > this->Options.minimumDisparity) ||
          disparity > this->Options.maximumDisparity)
        {
          return;
        }
        const double bright = MeanDifference(token.bright, index.Sides[segment.token][0]);
        const double dark = MeanDifference(token.dark, index.Sides[segment.token][1]);
        const double color =
          (0.75 * std::min(bright, dark) +
            0.25 * std::min(std::max(bright, dark), this->Options.colorTolerance)) /
          this->Options.colorTolerance;
        if (color >= 1)
        {
          return;
        }
        const double direction = (1 - alignment) / (1 - cosine);
        const double slope = segment.tangentU / segment.tangentV;
        candidates.push_back({ disparity, perColumn / std::abs(segment.tangentV),
          perColumn * (across.x() - across.y() * slope), 0.8 * color + 0.2 * direction, image,
          segment.token });
      });
  }

  // All that agree with one candidate, at most one from each image.
  Hypothesis Confirm(const Candidate& seed, const std::vector<Candidate>& candidates,
    std::size_t begin, std::size_t end) const
  {
    Hypothesis hypothesis;
    hypothesis.support.push_back(seed);
    for (int image = 0; image < static_cast<int>(this->Indices.size()); ++image)
    {
      const Candidate* best = nullptr;
      double bestCost = 1;
      for (std::size_t i = begin; i < end && image != seed.image; ++i)
      {
        const Candidate& other = candidates[i];
        const double off = std::abs(other.disparity - seed.disparity) /
          (this->Options.tolerance * std::max(seed.sigma, other.sigma));
        const double cost = 0.8 * other.cost + 0.2 * off;
        if (other.image == image && off <= 1 && cost < bestCost)
        {
          best = &other;
          bestCost = cost;
        }
      }
      if (best)
      {
        hypothesis.support.push_back(*best);
        hypothesis.support.back().cost = bestCost;
      }
    }
    double weights = 0;
    for (const Candidate& candidate : hypothesis.support)
    {
      const double weight = 1 / (candidate.sigma * candidate.sigma);
      weights += weight;
      hypothesis.disparity += weight * candidate.disparity;
      hypothesis.score += candidate.cost - 1;
    }
    hypothesis.disparity /= weights;
    return hypothesis;
  }

  // The best explanations of a token, each with two images at least.
  std::vector<Hypothesis> FindHypotheses(const EdgeToken& token) const
  {
    std::vector<Candidate> candidates;
    for (int image = 0; image < static_cast<int>(this->Indices.size()); ++image)
    {
      this->FindCandidates(token, image, candidates);
    }
    std::sort(candidates.begin(), candidates.end(),
      [](const Candidate& a, const Candidate& b) {
        return std::tie(a.disparity, a.image, a.token) < std::tie(b.disparity, b.image, b.token);
      });
    double widest = 0;
    for (const Candidate& candidate : candidates)
    {
      widest = std::max(widest, this->Options.tolerance * candidate.sigma);
    }
    std::vector<Hypothesis> hypotheses;
    std::size_t begin = 0, end = 0;
    for (const Candidate& seed : candidates)
    {
      while (candidates[begin].disparity < seed.disparity - widest)
      {
        ++begin;
      }
      while (end < candidates.size() && candidates[end].disparity <= seed.disparity + widest)
      {
        ++end;
      }
      Hypothesis hypothesis = this->Confirm(seed, candidates, begin, end);
      if (hypothesis.support.size() >= 2)
      {
        hypotheses.push_back(std::move(hypothesis));
      }
    }
    this->KeepBest(hypotheses);
    return hypotheses;
  }

  // Hypotheses less than half a tolerance apart are the same one.
  void KeepBest(std::vector<Hypothesis>& hypotheses) const
  {
    std::stable_sort(hypotheses.begin(), hypotheses.end(),
      [](const Hypothesis& a, const Hypothesis& b) { return a.score < b.score; });
    std::vector<Hypothesis> kept;
    for (Hypothesis& hypothesis : hypotheses)
    {
      const bool known = std::any_of(kept.begin(), kept.end(),
        [&](const Hypothesis& other) {
          return this->Pixels(hypothesis.disparity - other.disparity) < this->Options.tolerance / 2;
        });
      if (!known && static_cast<int>(kept.size()) < MaximumHypotheses)
      {
        kept.push_back(std::move(hypothesis));
      }
    }
    hypotheses = std::move(kept);
  }

  // A difference of disparities in pixels of the longest baseline.
  double Pixels(double disparity) const { return std::abs(disparity) * this->Baseline; }

  // Cost of going from one hypothesis to the next along a chain.
  double Transition(const Hypothesis& from, const Hypothesis& to, double step) const
  {
    constexpr double weight = 0.5, breakCost = 1.5;
    const double jump = this->Pixels(to.disparity - from.disparity);
    return std::min(
      breakCost, weight * jump / (this->Options.gradientLimit * step + this->Options.tolerance));
  }

  // Dynamic programming over the hypotheses of the tokens begin .. end - 1 and "none".
  void ChooseAlongChain(int begin, int end, std::vector<Hypothesis>& chosen) const
  {
    constexpr double noneCost = 0, toNoneCost = 0.3;
    const EdgeChains& edges = this->Reference.edges;
    std::vector<std::vector<Hypothesis>> hypotheses(end - begin);
    std::vector<std::vector<double>> cost(end - begin);
    std::vector<std::vector<int>> from(end - begin);
    for (int k = 0; k < end - begin; ++k)
    {
      hypotheses[k] = this->FindHypotheses(edges.tokens[begin + k]);
      hypotheses[k].emplace_back(); // none
      const std::size_t states = hypotheses[k].size();
      cost[k].assign(states, 0.0);
      from[k].assign(states, -1);
      for (std::size_t s = 0; s < states; ++s)
      {
        const bool none = s + 1 == states;
        const double own = none ? noneCost : hypotheses[k][s].score;
        cost[k][s] = own;
        if (k == 0)
        {
          continue;
        }
        const double step =
          (edges.tokens[begin + k].position - edges.tokens[begin + k - 1].position).norm();
        double best = std::numeric_limits<double>::infinity();
        for (std::size_t p = 0; p < cost[k - 1].size(); ++p)
        {
          const bool previousNone = p + 1 == cost[k - 1].size();
          const double transition = none && previousNone ? 0
            : none || previousNone                       ? toNoneCost
                                   : this->Transition(hypotheses[k - 1][p], hypotheses[k][s], step);
          if (cost[k - 1][p] + transition < best)
          {
            best = cost[k - 1][p] + transition;
            from[k][s] = static_cast<int>(p);
          }
        }
        cost[k][s] += best;
      }
    }
    int state = static_cast<int>(
      std::min_element(cost.back().begin(), cost.back().end()) - cost.back().begin());
    for (int k = end - begin - 1; k >= 0; --k)
    {
      chosen[begin + k] = std::move(hypotheses[k][state]);
      state = from[k][state];
    }
  }

  // A token of another image goes to the best of the tokens that claim it; neighbours along
  // one chain may share it.
  void EnforceUniqueness(std::vector<Hypothesis>& chosen) const
  {
    struct Claim
    {
      double score = 0;
      int token = -1;
    };
    std::vector<std::vector<Claim>> claims;
    for (const EpipolarIndex& index : this->Indices)
    {
      claims.emplace_back(index.Sides.size());
    }
    for (int i = 0; i < static_cast<int>(chosen.size()); ++i)
    {
      for (const Candidate& candidate : chosen[i].support)
      {
        Claim& claim = claims[candidate.image][candidate.token];
        if (chosen[i].score < claim.score)
        {
          claim = { chosen[i].score, i };
        }
      }
    }
    constexpr double neighbor = 3; // pixels
    for (Hypothesis& hypothesis : chosen)
    {
      const std::size_t i = &hypothesis - chosen.data();
      const auto lost = [&](const Candidate& candidate)
      {
        const int owner = claims[candidate.image][candidate.token].token;
        return (this->Reference.edges.tokens[owner].position -
                 this->Reference.edges.tokens[i].position)
                 .norm() > neighbor;
      };
      auto& support = hypothesis.support;
      support.erase(std::remove_if(support.begin(), support.end(), lost), support.end());
      if (support.size() < 2)
      {
        support.clear();
      }
    }
  }

  // The point nearest to all edge lines: unknown are the disparity and the token's shift across the
  // edge in the reference image.
  EdgeMatch Refine(const EdgeToken& token, const Hypothesis& hypothesis) const
  {
    Eigen::Matrix2d normal;
    normal << 0, 0, 0, 1; // the reference's own line: shift = 0, to a pixel
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    double cost = 0;
    for (const Candidate& candidate : hypothesis.support)
    {
      const Eigen::Vector2d row(1, -candidate.shift);
      const double weight = 1 / (candidate.sigma * candidate.sigma);
      normal += weight * row * row.transpose();
      right += weight * row * candidate.disparity;
      cost += candidate.cost;
    }
    const Eigen::Vector2d solution = normal.inverse() * right;
    EdgeMatch match;
    match.images = static_cast<int>(hypothesis.support.size());
    match.disparity = solution.x();
    match.imagePoint = token.position + solution.y() * token.Normal();
    match.cost = cost / match.images;
    return match;
  }

  // Refines what is left of a chain, drops what jumps and what is short.
  void KeepLongRuns(
    int begin, int end, const std::vector<Hypothesis>& chosen, std::vector<EdgeMatch>& matches)
  {
    const EdgeChains& edges = this->Reference.edges;
    std::vector<int> run;
    const auto finish = [&]()
    {
      if (static_cast<int>(run.size()) >= this->Options.minimumRun)
      {
        for (int i : run)
        {
          matches[i].run = this->NumberOfRuns;
        }
        ++this->NumberOfRuns;
      }
      else
      {
        for (int i : run)
        {
          matches[i] = EdgeMatch();
        }
      }
      run.clear();
    };
    for (int i = begin; i < end; ++i)
    {
      if (chosen[i].support.empty())
      {
        continue;
      }
      matches[i] = this->Refine(edges.tokens[i], chosen[i]);
      if (!run.empty())
      {
        const double step = (edges.tokens[i].position - edges.tokens[run.back()].position).norm();
        const double jump = this->Pixels(matches[i].disparity - matches[run.back()].disparity);
        if (step > 5 || jump > this->Options.gradientLimit * step + this->Options.tolerance)
        {
          finish();
        }
      }
      run.push_back(i);
    }
    finish();
  }

  const ImageEdges& Reference;
  const MatcherOptions& Options;
  double MinimumSine;
  double Baseline = 0; // the longest one
  std::vector<EpipolarIndex> Indices;
  int NumberOfRuns = 0;
};

}

void MatcherOptions::Check() const
{
  if (!(this->minimumDisparity >= 0) || !(this->maximumDisparity > this->minimumDisparity))
  {
    throw Error("The least disparity must not be negative and must lie below the greatest.");
  }
  if (!(this->tolerance > 0) || !(this->colorTolerance > 0) || !(this->gradientLimit > 0) ||
    this->minimumRun < 1)
  {
    throw Error("The tolerances of edge matching and the least run must be positive.");
  }
  if (!(this->minimumAngle > 0 && this->minimumAngle < 90) ||
    !(this->angleTolerance > 0 && this->angleTolerance < 90))
  {
    throw Error("The angles of edge matching must lie between 0 and 90 degrees.");
  }
}

std::vector<EdgeMatch> MatchEdges(
  const ImageEdges& reference, const std::vector<ImageEdges>& others, const MatcherOptions& options)
{
  options.Check();
  if (others.size() < 2)
  {
    throw Error("Trinocular matching needs three images.");
  }
  return Matcher(reference, others, options).Run();
}

}
