// SPDX-License-Identifier: BSD-3-Clause
#include "Matching/CandidateSearch.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

namespace
{

double Radians(double degrees)
{
  return degrees * 3.14159265358979323846 / 180;
}

// Maximum number of pieces over which an edge of another image is followed.
constexpr int FarthestLead = 8;

}

CandidateSearch::SearchImage::SearchImage(const ImageEdges& reference,
  const ColorStatistics& referenceColors, const ImageEdges& other, double minimumSine)
  : pair(reference.camera, other.camera)
  , index(pair, other.edges, minimumSine)
  , colors(other.edges, ColorStatistics(other.edges), referenceColors)
  , numberOfTokens(other.edges.tokens.size())
{
}

CandidateSearch::CandidateSearch(
  const ImageEdges& reference, const std::vector<ImageEdges>& others, const MatcherOptions& options)
  : Edges(reference.edges)
  , Options(options)
  , MinimumSine(std::sin(Radians(options.minimumAngle)))
  , MinimumCosine(std::cos(Radians(options.angleTolerance)))
  , Statistics(reference.edges)
  , Colors(reference.edges, this->Statistics, this->Statistics)
  , Meetings(others.size())
{
  for (const ImageEdges& other : others)
  {
    this->Images.emplace_back(reference, this->Statistics, other, this->MinimumSine);
    this->Baseline = std::max(this->Baseline, this->Images.back().pair.Baseline);
  }
  this->Lines.resize(this->Images.size());
  this->Rays.resize(this->Images.size());
}

void CandidateSearch::FindRays(int begin, int end)
{
  this->FirstRay = begin;
  for (std::size_t i = 0; i < this->Images.size(); ++i)
  {
    this->Rays[i].Compute(
      this->Images[i].pair.ReferenceHomography(), &this->Edges.tokens[begin], end - begin);
  }
}

int CandidateSearch::FindLines(int token)
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

// Few of all the edges that cross the epipolar lines can be confirmed, and only these are compared
// with the token.
void CandidateSearch::FindCandidates(int token, const std::vector<char>& skip)
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
    if (this->Lines[image].usable && !skip[image])
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

// How close a candidate must be to one that it can confirm, given its error; a little more than
// exact, because what is close enough is checked again.
float CandidateSearch::Reach(float sigma) const
{
  constexpr float more = 1.01f, least = 0.01f;
  return least + more * static_cast<float>(Promising * this->Options.tolerance) * sigma;
}

// Finds the edges of one image on the epipolar line of the selected token.
void CandidateSearch::FindCrossings(int image)
{
  const SearchImage& search = this->Images[image];
  const EpipolarLine& line = this->Lines[image];
  EpipolarIndex::Search wanted;
  wanted.near = static_cast<float>(search.pair.Column(line.ray, this->Options.maximumDisparity));
  wanted.far = static_cast<float>(search.pair.Column(line.ray, this->Options.minimumDisparity));
  wanted.tangentU = line.tangent.x();
  wanted.tangentV = line.tangent.y();
  wanted.minimumCosine = static_cast<float>(this->MinimumCosine);
  // Pixels of the longest baseline for each pixel of this one.
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

void CandidateSearch::AddLead(const EdgeCandidate& candidate)
{
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

void CandidateSearch::FollowLeads(int token)
{
  for (const EdgeCandidate& lead : this->Leads)
  {
    this->Follow(token, lead);
  }
}

// Adds the edge of a neighbour's candidate where it crosses the epipolar line of the token.
void CandidateSearch::Follow(int token, const EdgeCandidate& candidate)
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

bool CandidateSearch::IsCandidate(int image, int token) const
{
  return std::any_of(this->Candidates.begin(), this->Candidates.end(),
    [&](const EdgeCandidate& candidate)
    { return candidate.token == token && candidate.image == image; });
}

// Adds a piece of another image's edge to the candidates if it looks like the token.
void CandidateSearch::AddCandidate(int token, int image, int other, float u, float cosine)
{
  const SearchImage& search = this->Images[image];
  const EpipolarLine& line = this->Lines[image];
  const EpipolarIndex::Piece& piece = search.index.PieceOf(other);
  // Along the epipolar line, both edges go from dark to bright or both from bright to dark, except
  // on the silhouette of an object that is brighter than its background here and darker there.
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

// 0 for the same appearance, 1 or more for edges that cannot be the same. The better side decides,
// which on a silhouette is that of the object; the other one has a small weight. When bright and
// dark are crossed, one side must be very similar.
float CandidateSearch::CompareTokens(
  int token, const SideColors& colors, int other, bool crossed, float alignment) const
{
  constexpr float worseSide = 0.2f, direction = 0.2f, strictness = 2.5f;
  const float scale = (crossed ? strictness : 1) / static_cast<float>(this->Options.colorTolerance);
  const auto [bright, dark] = this->Colors.Difference(token, colors, other, crossed);
  const float better = std::min(bright, dark) * scale;
  const float worse = std::min(1.0f, std::max(bright, dark) * scale);
  return better >= 1 ? 1
                     : (1 - worseSide - direction) * better + worseSide * worse +
      direction * (1 - alignment) / static_cast<float>(1 - this->MinimumCosine);
}

}
