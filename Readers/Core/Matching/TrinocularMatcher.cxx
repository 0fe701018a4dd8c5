// SPDX-License-Identifier: BSD-3-Clause
#include "Matching/TrinocularMatcher.h"

#include "Common/Error.h"
#include "Edges/SideColors.h"
#include "Edges/VectorClones.h"
#include "Epipolar/EpipolarIndex.h"
#include "Epipolar/EpipolarRays.h"
#include "Matching/DisparityPrior.h"
#include "Matching/ProximityBins.h"
#include "Matching/RunFilter.h"
#include "Matching/RunFitting.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>

namespace freespace
{

namespace
{

double Radians(double degrees)
{
  return degrees * 3.14159265358979323846 / 180;
}

// Another image, ready to be searched.
struct SearchImage
{
  SearchImage(const ImageEdges& reference, const ColorStatistics& referenceColors,
    const ImageEdges& other, double minimumSine)
    : pair(reference.camera, other.camera)
    , index(pair, other.edges, minimumSine)
    , colors(other.edges, ColorStatistics(other.edges), referenceColors)
    , numberOfTokens(other.edges.tokens.size())
  {
  }

  // What a candidate is compared by.
  void Prefetch(int token) const
  {
    FREESPACE_PREFETCH(&this->index.PieceOf(token));
    this->colors.Prefetch(token);
  }

  EpipolarPair pair;
  EpipolarIndex index;
  SideColors colors;
  std::size_t numberOfTokens;
};

// A token's, in another image.
struct EpipolarLine
{
  EpipolarPair::Ray ray;
  Eigen::Vector2f tangent; // of the edge, rectified
  Eigen::Vector2f across;  // way of the rectified pixel when the token moves one pixel across
  bool usable;             // in front of the camera, the edge not too near to parallel
};

// Where an edge of another image crosses the epipolar line of a token.
struct Crossing
{
  float place;  // its disparity, pixels of the longest baseline
  float reach;  // to one that it can confirm, in the same pixels
  float u;      // rectified column
  float cosine; // of the angle between both edges
  int image;
  int token;
};

// The hypotheses of a token are the states begin .. end - 1 of its chain.
struct TokenStates
{
  int begin = 0, end = 0;
};

// Candidates that miss each other by so many tolerances may meet at a neighbour along the chain.
constexpr double Promising = 2;

// An edge of another image is followed over so many pieces.
constexpr int FarthestLead = 8;

class Matcher
{
public:
  Matcher(const ImageEdges& reference, const std::vector<ImageEdges>& others,
    const MatcherOptions& options)
    : Edges(reference.edges)
    , Options(options)
    , MinimumSine(std::sin(Radians(options.minimumAngle)))
    , MinimumCosine(std::cos(Radians(options.angleTolerance)))
    , Statistics(reference.edges)
    , Colors(reference.edges, this->Statistics, this->Statistics)
    , Continued(others.size())
    , Meetings(others.size())
  {
    for (const ImageEdges& other : others)
    {
      this->Images.emplace_back(reference, this->Statistics, other, this->MinimumSine);
      this->Baseline = std::max(this->Baseline, this->Images.back().pair.Baseline);
    }
    this->Lines.resize(this->Images.size());
    this->Rays.resize(this->Images.size());
    this->Agreeing.resize(this->Images.size());
    this->AgreeingCost.resize(this->Images.size());
  }

  LargeVector<EdgeMatch> Match()
  {
    this->Chosen.resize(this->Edges.tokens.size());
    this->Support.reserve(this->Images.size() * this->Edges.tokens.size());
    std::vector<std::size_t> ambiguous; // chains
    for (std::size_t chain = 0; chain < this->Edges.NumberOfChains(); ++chain)
    {
      if (this->ChooseAlongChain(this->Edges.begin[chain], this->Edges.begin[chain + 1]))
      {
        ambiguous.push_back(chain);
      }
    }
    this->LearnPrior(ambiguous);
    for (std::size_t chain : ambiguous)
    {
      this->ChooseAlongChain(this->Edges.begin[chain], this->Edges.begin[chain + 1]);
    }
    this->EnforceUniqueness();
    LargeVector<EdgeMatch> matches =
      MatchRuns(this->Edges, std::move(this->Chosen), this->Support, this->Baseline, this->Options);
    DropLonelyRuns(this->Edges, this->Baseline, this->Options, matches);
    return matches;
  }

private:
  // What the chains that are sure of their match tell about the others' surroundings.
  void LearnPrior(const std::vector<std::size_t>& ambiguous)
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
      if (sure[i] && this->Chosen[i].Confirmed())
      {
        pixels.push_back(this->Edges.tokens[i].position);
        disparities.push_back(this->Chosen[i].disparity);
      }
    }
    this->Prior = std::make_unique<DisparityPrior>(pixels, disparities);
  }

  // How the epipolar lines of a chain's tokens lie in each image.
  void FindRays(int begin, int end)
  {
    this->FirstRay = begin;
    for (std::size_t i = 0; i < this->Images.size(); ++i)
    {
      this->Rays[i].Compute(
        this->Images[i].pair.ReferenceHomography(), &this->Edges.tokens[begin], end - begin);
    }
  }

  // And that of one of its tokens. Returns in how many images it can be looked for.
  int FindLines(int token)
  {
    int usable = 0;
    const int k = token - this->FirstRay;
    for (std::size_t i = 0; i < this->Images.size(); ++i)
    {
      const EpipolarRays& rays = this->Rays[i];
      EpipolarLine& line = this->Lines[i];
      line.ray = rays.At(k);
      line.tangent =
        Eigen::Vector2f(static_cast<float>(rays.tangentU[k]), static_cast<float>(rays.tangentV[k]));
      line.across =
        Eigen::Vector2f(static_cast<float>(rays.acrossU[k]), static_cast<float>(rays.acrossV[k]));
      line.usable = line.ray.scale > 0 && std::abs(line.tangent.y()) >= this->MinimumSine;
      usable += line.usable;
    }
    return usable;
  }

  // The edges on the epipolar lines of a token which an edge of another image may confirm. Few of
  // all that cross the lines do, and only these are looked at.
  void FindCandidates(int token)
  {
    const float pixels = static_cast<float>(this->Baseline);
    this->Crossings.clear();
    this->Meetings.Clear();
    for (const EdgeCandidate& known : this->Candidates)
    {
      this->Meetings.Add(known.image, static_cast<float>(known.disparity) * pixels,
        this->Reach(static_cast<float>(known.sigma) * pixels));
    }
    for (std::size_t image = 0; image < this->Images.size(); ++image)
    {
      if (this->Lines[image].usable && !this->Continued[image])
      {
        this->FindCrossings(static_cast<int>(image));
      }
    }
    this->Meetings.Finish();
    const auto alone = [this](const Crossing& crossing)
    { return !this->Meetings.Meets(crossing.image, crossing.place, crossing.reach); };
    this->Crossings.erase(
      std::remove_if(this->Crossings.begin(), this->Crossings.end(), alone), this->Crossings.end());
    for (const Crossing& crossing : this->Crossings)
    {
      this->Images[crossing.image].Prefetch(crossing.token);
    }
    for (const Crossing& crossing : this->Crossings)
    {
      if (!this->IsCandidate(crossing.image, crossing.token))
      {
        this->AddCandidate(token, crossing.image, crossing.token, crossing.u, crossing.cosine);
      }
    }
  }

  // How near a candidate must be to one that it can confirm, given its error; a little more than
  // the truth, because what is near enough is looked at again.
  float Reach(float sigma) const
  {
    constexpr float more = 1.01f, least = 0.01f;
    return least + more * static_cast<float>(Promising * this->Options.tolerance) * sigma;
  }

  // The edges of one image on the epipolar line of a token.
  void FindCrossings(int image)
  {
    const SearchImage& search = this->Images[image];
    const EpipolarLine& line = this->Lines[image];
    EpipolarIndex::Search wanted;
    wanted.near = static_cast<float>(search.pair.Column(line.ray, this->Options.maximumDisparity));
    wanted.far = static_cast<float>(search.pair.Column(line.ray, this->Options.minimumDisparity));
    wanted.tangentU = line.tangent.x();
    wanted.tangentV = line.tangent.y();
    wanted.minimumCosine = static_cast<float>(this->MinimumCosine);
    // Pixels of the longest baseline for each of this one's.
    const float scale = static_cast<float>(line.ray.scale / search.pair.Baseline * this->Baseline);
    const float zero = static_cast<float>(line.ray.u);
    search.index.VisitRow(line.ray.v, wanted,
      [&](int other, float u, float cosine, float width)
      {
        const float place = (zero - u) * scale, reach = this->Reach(width * scale);
        this->Crossings.push_back({ place, reach, u, cosine, image, other });
        this->Meetings.Add(image, place, reach);
      });
  }

  // The support of a neighbour's hypotheses, which leads to that of the tokens beside it. What
  // leads along the same edge is taken once.
  void AddLeads(const TokenStates& states)
  {
    constexpr float margin = 1.0f; // what is worse by more than that is not chosen along the chain
    for (int s = states.begin; s < states.end; ++s)
    {
      const EdgeHypothesis& state = this->States[s];
      if (state.score > this->States[states.begin].score + margin)
      {
        break; // the best come first
      }
      for (int k = state.begin; k < state.begin + state.count && state.promising; ++k)
      {
        const EdgeCandidate& candidate = this->Scratch[k];
        const EpipolarIndex& index = this->Images[candidate.image].index;
        const bool known = std::any_of(this->Leads.begin(), this->Leads.end(),
          [&](const EdgeCandidate& lead)
          {
            return lead.image == candidate.image &&
              index.Connects(lead.token, candidate.token, FarthestLead);
          });
        if (!known)
        {
          this->Leads.push_back(candidate);
        }
      }
    }
  }

  void FollowLeads(int token)
  {
    for (const EdgeCandidate& lead : this->Leads)
    {
      this->Follow(token, lead);
    }
  }

  // Takes the edge of a neighbour's candidate where it crosses the token's epipolar line.
  void Follow(int token, const EdgeCandidate& candidate)
  {
    const EpipolarLine& line = this->Lines[candidate.image];
    const EpipolarIndex& index = this->Images[candidate.image].index;
    const float row = static_cast<float>(line.ray.v);
    const int other = line.usable ? index.Follow(candidate.token, row, FarthestLead) : -1;
    if (other < 0)
    {
      return;
    }
    const EpipolarIndex::Piece& piece = index.PieceOf(other);
    const float column = piece.ColumnAt(row);
    const double disparity = this->Images[candidate.image].pair.Disparity(line.ray, column);
    const bool within =
      disparity >= this->Options.minimumDisparity && disparity <= this->Options.maximumDisparity;
    const float cosine =
      std::abs(line.tangent.x() * piece.tangentU + line.tangent.y() * piece.tangentV);
    if (within && cosine >= this->MinimumCosine && !this->IsCandidate(candidate.image, other))
    {
      this->AddCandidate(token, candidate.image, other, column, cosine);
    }
  }

  bool IsCandidate(int image, int token) const
  {
    return std::any_of(this->Candidates.begin(), this->Candidates.end(),
      [&](const EdgeCandidate& candidate)
      { return candidate.token == token && candidate.image == image; });
  }

  // Takes a piece of another image's edge for a candidate when it looks like the token.
  void AddCandidate(int token, int image, int other, float u, float cosine)
  {
    const SearchImage& search = this->Images[image];
    const EpipolarLine& line = this->Lines[image];
    const EpipolarIndex::Piece& piece = search.index.PieceOf(other);
    // Along the epipolar line, both edges go from dark to bright or both from bright to dark. Not
    // so on the silhouette of something that is brighter than what it hides here and darker there.
    const bool crossed = (line.tangent.y() > 0) != (piece.tangentV > 0);
    const float cost = this->CompareTokens(token, search.colors, other, crossed, cosine);
    if (cost < 1)
    {
      const float perColumn = static_cast<float>(line.ray.scale / search.pair.Baseline);
      const float slope = piece.tangentU / piece.tangentV;
      this->Candidates.push_back({ search.pair.Disparity(line.ray, u),
        perColumn * piece.uncertainty / std::abs(piece.tangentV),
        perColumn * (line.across.x() - line.across.y() * slope), cost, image, other });
    }
  }

  // 0 for the same look, 1 or more for edges that cannot be the same. The better side decides,
  // which on a silhouette is that of the object; the other one has a little say. When bright and
  // dark are crossed, one side must be much the same.
  float CompareTokens(
    int token, const SideColors& colors, int other, bool crossed, float alignment) const
  {
    constexpr float worseSide = 0.2f, direction = 0.2f, strictness = 2.5f;
    const float scale =
      (crossed ? strictness : 1) / static_cast<float>(this->Options.colorTolerance);
    const auto [bright, dark] = this->Colors.Difference(token, colors, other, crossed);
    const float better = std::min(bright, dark) * scale;
    const float worse = std::min(1.0f, std::max(bright, dark) * scale);
    return better >= 1 ? 1
                       : (1 - worseSide - direction) * better + worseSide * worse +
        direction * (1 - alignment) / static_cast<float>(1 - this->MinimumCosine);
  }

  // Makes a hypothesis of one candidate and all that agree with it, at most one from each image.
  void Confirm(const EdgeCandidate& seed, std::size_t begin, std::size_t end)
  {
    constexpr float distance = 0.2f; // share of the distance in the cost
    std::fill(this->Agreeing.begin(), this->Agreeing.end(), nullptr);
    std::fill(this->AgreeingCost.begin(), this->AgreeingCost.end(), 1.0f);
    EdgeHypothesis hypothesis;
    for (std::size_t i = begin; i < end; ++i)
    {
      const EdgeCandidate& other = this->Candidates[i];
      const double difference = std::abs(other.disparity - seed.disparity);
      const double most = this->Options.tolerance * std::max(seed.sigma, other.sigma);
      if (other.image == seed.image || difference > Promising * most)
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

    hypothesis.begin = static_cast<int>(this->Scratch.size());
    double weights = 0;
    for (std::size_t image = 0; image < this->Images.size(); ++image)
    {
      if (const EdgeCandidate* candidate = this->Agreeing[image])
      {
        const double weight = candidate->Weight();
        weights += weight;
        hypothesis.disparity += weight * candidate->disparity;
        hypothesis.score += this->AgreeingCost[image] - 1;
        this->Scratch.push_back(*candidate);
        this->Scratch.back().cost = this->AgreeingCost[image];
        ++hypothesis.count;
      }
    }
    constexpr float unconfirmed = 0.3f; // worth of a match in one image only
    hypothesis.disparity /= weights;
    hypothesis.sigma = static_cast<float>(1 / std::sqrt(weights));
    hypothesis.score *= hypothesis.Confirmed() ? 1 : unconfirmed;
    this->Found.push_back(hypothesis);
  }

  // The explanations of all tokens of a chain. What is matched continues over several tokens: every
  // fourth searches its epipolar lines, those between follow what it found along the other images'
  // edges.
  void FindHypothesesAlongChain(int begin, int end)
  {
    const int stride = std::clamp(this->Options.minimumRun, 1, 4);
    this->TokenStatesOf.resize(end - begin);
    this->FindRays(begin, end);
    this->LastSearched = begin;
    this->SearchFrom(begin, TokenStates());
    for (int last = begin; last + 1 < end;)
    {
      const int next = std::min(last + stride, end - 1);
      this->SearchFrom(next, this->TokenStatesOf[last - begin]);
      this->AddLeads(this->TokenStatesOf[next - begin]); // beside those of the last one
      for (int token = last + 1; token < next; ++token)
      {
        this->Candidates.clear();
        this->FindLines(token);
        this->FollowLeads(token);
        this->TokenStatesOf[token - begin] = this->FindHypotheses(token);
      }
      last = next;
    }
  }

  // Looks for the explanations of a token: those that its neighbour leads to and, where these are
  // not as good as can be, others along the epipolar lines.
  void SearchFrom(int token, const TokenStates& neighbor)
  {
    TokenStates& states = this->TokenStatesOf[token - this->FirstRay];
    this->Candidates.clear();
    this->Leads.clear();
    this->AddLeads(neighbor);
    const int usable = this->FindLines(token);
    this->FollowLeads(token);
    if (usable < 2) // one image confirms nothing
    {
      states = this->FindHypotheses(token);
      return;
    }
    std::fill(this->Continued.begin(), this->Continued.end(), 0);
    constexpr int longest = 32; // without a search, tokens
    if (!this->Candidates.empty() && token - this->LastSearched < longest)
    {
      const std::size_t support = this->Scratch.size();
      states = this->FindHypotheses(token);
      if (this->ContinuesEverywhere(this->States[states.begin]))
      {
        return;
      }
      this->States.resize(states.begin);
      this->Scratch.resize(support);
    }
    if (std::find(this->Continued.begin(), this->Continued.end(), 1) == this->Continued.end())
    {
      this->LastSearched = token;
    }
    this->FindCandidates(token);
    states = this->FindHypotheses(token);
  }

  // Whether a hypothesis is confirmed and looks right in all images that may show it; notes those
  // where it does.
  bool ContinuesEverywhere(const EdgeHypothesis& best)
  {
    constexpr double good = 0.12; // mean cost
    if (!best.Confirmed() || best.score > (good - 1) * best.count)
    {
      return false;
    }
    for (int k = best.begin; k < best.begin + best.count; ++k)
    {
      this->Continued[this->Scratch[k].image] = 1;
    }
    bool everywhere = true;
    for (std::size_t image = 0; image < this->Images.size(); ++image)
    {
      everywhere = everywhere && (this->Continued[image] || !this->Lines[image].usable);
    }
    return everywhere;
  }

  // Appends the best explanations of a token by its candidates and "no match" to the states of its
  // chain.
  TokenStates FindHypotheses(int token)
  {
    TokenStates states;
    states.begin = static_cast<int>(this->States.size());
    this->Found.clear();
    std::sort(this->Candidates.begin(), this->Candidates.end(),
      [](const EdgeCandidate& a, const EdgeCandidate& b)
      {
        return a.disparity != b.disparity ? a.disparity < b.disparity
                                          : std::tie(a.image, a.token) < std::tie(b.image, b.token);
      });
    double widest = 0;
    for (const EdgeCandidate& candidate : this->Candidates)
    {
      widest = std::max(widest, Promising * this->Options.tolerance * candidate.sigma);
    }
    std::size_t begin = 0, end = 0;
    for (const EdgeCandidate& seed : this->Candidates)
    {
      while (this->Candidates[begin].disparity < seed.disparity - widest)
      {
        ++begin;
      }
      while (
        end < this->Candidates.size() && this->Candidates[end].disparity <= seed.disparity + widest)
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

  // A repeated pattern matches itself at several disparities: the one that is usual around it wins.
  void ApplyPrior(int token)
  {
    constexpr double weight = 0.4, scale = 8; // pixels of the longest baseline
    const double usual = this->Prior ? this->Prior->At(this->Edges.tokens[token].position) : 0;
    for (EdgeHypothesis& hypothesis : this->Found)
    {
      if (usual > 0)
      {
        const double off = std::abs(hypothesis.disparity - usual) * this->Baseline / scale;
        hypothesis.score += static_cast<float>(weight * std::min(1.0, off));
      }
    }
  }

  // Hypotheses less than half a tolerance apart are the same one.
  void KeepBest()
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

  double Step(int from, int to) const
  {
    return (this->Edges.tokens[to].position - this->Edges.tokens[from].position).norm();
  }

  // Cost of going from one state to the next along a chain.
  double Transition(const EdgeHypothesis& from, const EdgeHypothesis& to, double step) const
  {
    constexpr double weight = 0.5, breakCost = 1.5, beginOrEnd = 0.3;
    if (from.Empty() || to.Empty())
    {
      return from.Empty() == to.Empty() ? 0 : beginOrEnd;
    }
    return std::min(
      breakCost, weight * DisparityJump(from, to, step, this->Baseline, this->Options));
  }

  // Dynamic programming over the states of the tokens begin .. end - 1: the sum of the scores and
  // of the transitions becomes least. Returns whether another match would have been about as good
  // for most of the tokens.
  bool ChooseAlongChain(int begin, int end)
  {
    this->States.clear();
    this->Scratch.clear();
    this->FindHypothesesAlongChain(begin, end);
    std::vector<double>& cost = this->StateCost;
    std::vector<int>& from = this->StateFrom;
    cost.resize(this->States.size());
    from.resize(this->States.size());
    TokenStates before;
    for (int token = begin; token < end; ++token)
    {
      const TokenStates states = this->TokenStatesOf[token - begin];
      const double step = token > begin ? this->Step(token - 1, token) : 0;
      for (int s = states.begin; s < states.end; ++s)
      {
        double best = token > begin ? std::numeric_limits<double>::infinity() : 0;
        int bestFrom = -1;
        for (int p = before.begin; p < before.end; ++p)
        {
          if (cost[p] >= best) // no transition makes it less
          {
            continue;
          }
          const double sum = cost[p] + this->Transition(this->States[p], this->States[s], step);
          if (sum < best)
          {
            best = sum;
            bestFrom = p;
          }
        }
        cost[s] = best + this->States[s].score;
        from[s] = bestFrom;
      }
      before = states;
    }
    int state = static_cast<int>(
      std::min_element(cost.begin() + before.begin, cost.begin() + before.end) - cost.begin());
    int matched = 0, ambiguous = 0;
    for (int token = end - 1; token >= begin; --token)
    {
      matched += this->States[state].Confirmed();
      ambiguous += this->HasRival(state, this->TokenStatesOf[token - begin].begin);
      this->Choose(token, this->States[state]);
      state = from[state];
    }
    return 2 * ambiguous > matched;
  }

  // Whether a token with these states has another one that is about as good as the one chosen.
  bool HasRival(int chosen, int first) const
  {
    constexpr double margin = 0.3;
    for (int s = first; !this->States[s].Empty() && this->States[chosen].Confirmed(); ++s)
    {
      if (s != chosen && this->States[s].Confirmed() &&
        this->States[s].score < this->States[chosen].score + margin)
      {
        return true;
      }
    }
    return false;
  }

  void Choose(int token, const EdgeHypothesis& hypothesis)
  {
    this->Chosen[token] = hypothesis;
    this->Chosen[token].begin = static_cast<int>(this->Support.size());
    this->Support.insert(this->Support.end(), this->Scratch.begin() + hypothesis.begin,
      this->Scratch.begin() + hypothesis.begin + hypothesis.count);
  }

  // A token of another image goes to the best of the tokens that claim it; neighbours along one
  // edge may share it.
  void EnforceUniqueness()
  {
    constexpr double neighbor = 3; // pixels
    std::vector<std::vector<int>> owners;
    for (const SearchImage& image : this->Images)
    {
      owners.emplace_back(image.numberOfTokens, -1);
    }
    const auto visitSupport = [this](int token, auto&& visit)
    {
      const EdgeHypothesis& hypothesis = this->Chosen[token];
      for (int k = hypothesis.begin; k < hypothesis.begin + hypothesis.count; ++k)
      {
        visit(this->Support[k]);
      }
    };
    const int count = static_cast<int>(this->Chosen.size());
    for (int token = 0; token < count; ++token)
    {
      visitSupport(token,
        [&](const EdgeCandidate& candidate)
        {
          int& owner = owners[candidate.image][candidate.token];
          if (owner < 0 || this->Chosen[token].score < this->Chosen[owner].score)
          {
            owner = token;
          }
        });
    }
    for (int token = 0; token < count; ++token)
    {
      EdgeHypothesis& hypothesis = this->Chosen[token];
      const auto begin = this->Support.begin() + hypothesis.begin;
      const auto kept = std::remove_if(begin, begin + hypothesis.count,
        [&](const EdgeCandidate& candidate)
        { return this->Step(owners[candidate.image][candidate.token], token) > neighbor; });
      hypothesis.count = static_cast<int>(kept - begin);
    }
  }

  const EdgeChains& Edges; // of the reference
  const MatcherOptions& Options;
  double MinimumSine;
  double MinimumCosine;
  ColorStatistics Statistics; // of the reference
  SideColors Colors;          // of the reference
  std::vector<SearchImage> Images;
  double Baseline = 0; // the longest one

  std::unique_ptr<DisparityPrior> Prior; // none in the first round

  std::vector<EpipolarRays> Rays; // of a chain, per image
  int FirstRay = 0;               // the token where it begins
  int LastSearched = 0;           // the last token that searched all its lines

  // One token's.
  std::vector<EpipolarLine> Lines; // per image
  std::vector<char> Continued;     // per image: a good match goes on there
  std::vector<EdgeCandidate> Leads;
  std::vector<Crossing> Crossings;
  ProximityBins Meetings;
  std::vector<EdgeCandidate> Candidates;
  std::vector<EdgeHypothesis> Found;
  std::vector<std::pair<double, int>> Order;  // of what was found, by score
  std::vector<const EdgeCandidate*> Agreeing; // per image
  std::vector<float> AgreeingCost;
  // One chain's: the hypotheses of its tokens, each list ending in "no match", and their support.
  std::vector<EdgeHypothesis> States;
  std::vector<EdgeCandidate> Scratch;
  std::vector<TokenStates> TokenStatesOf;
  std::vector<double> StateCost; // of the best way to each state
  std::vector<int> StateFrom;    // and the state before it on that way
  // The result: one hypothesis per token, and their support.
  LargeVector<EdgeHypothesis> Chosen;
  LargeVector<EdgeCandidate> Support;
};

}

LargeVector<EdgeMatch> MatchEdges(
  const ImageEdges& reference, const std::vector<ImageEdges>& others, const MatcherOptions& options)
{
  options.Check();
  if (others.size() < 2)
  {
    throw Error("Trinocular matching needs three images.");
  }
  return Matcher(reference, others, options).Match();
}

}
