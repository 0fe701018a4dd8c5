// SPDX-License-Identifier: BSD-3-Clause
#include "EpipolarIndex.h"

#include <algorithm>
#include <limits>

namespace freespace
{

namespace
{

using Segment = EpipolarIndex::Segment;

std::vector<Segment> RectifiedSegments(
  const EpipolarPair& pair, const EdgeChains& edges, double minimumSine)
{
  std::vector<Segment> segments;
  segments.reserve(edges.tokens.size());
  for (std::size_t chain = 0; chain < edges.NumberOfChains(); ++chain)
  {
    EpipolarPair::Ray next = pair.FromOther(edges.tokens[edges.begin[chain]].position);
    for (int i = edges.begin[chain]; i + 1 < edges.begin[chain + 1]; ++i)
    {
      const EpipolarPair::Ray ray = next;
      next = pair.FromOther(edges.tokens[i + 1].position);
      if (!(ray.scale > 0) || !(next.scale > 0) || ray.v == next.v)
      {
        continue;
      }
      const EdgeToken& token = edges.tokens[i];
      const Eigen::Vector2d tangent = (pair.OtherJacobian(ray) * token.tangent).normalized();
      if (std::abs(tangent.y()) >= minimumSine)
      {
        segments.push_back({ static_cast<float>(std::min(ray.v, next.v)),
          static_cast<float>(std::max(ray.v, next.v)), static_cast<float>(ray.u),
          static_cast<float>(ray.v), static_cast<float>((next.u - ray.u) / (next.v - ray.v)),
          static_cast<float>(tangent.x()), static_cast<float>(tangent.y()),
          static_cast<float>(token.Uncertainty()), i });
      }
    }
  }
  // Distributed to their rows in this order, they stay sorted.
  std::sort(segments.begin(), segments.end(),
    [](const Segment& a, const Segment& b)
    { return a.u < b.u || (a.u == b.u && a.token < b.token); });
  return segments;
}

}

EpipolarIndex::EpipolarIndex(const EpipolarPair& pair, const EdgeChains& edges, double minimumSine)
{
  const std::vector<Segment> segments = RectifiedSegments(pair, edges, minimumSine);
  if (segments.empty())
  {
    return;
  }
  float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
  for (const Segment& segment : segments)
  {
    low = std::min(low, segment.low);
    high = std::max(high, segment.high);
    this->Widest = std::max(this->Widest, std::abs(segment.slope) * (segment.high - segment.low));
  }
  this->FirstRow = std::floor(low);
  const auto visitRows = [this](const Segment& segment, auto&& visit)
  {
    const int first = static_cast<int>(std::floor(segment.low) - this->FirstRow);
    const int last = static_cast<int>(std::floor(segment.high) - this->FirstRow);
    for (int row = first; row <= last; ++row)
    {
      visit(2 * row + (segment.tangentV > 0));
    }
  };
  this->Begin.assign(2 * static_cast<int>(std::floor(high) - this->FirstRow) + 3, 0);
  for (const Segment& segment : segments)
  {
    visitRows(segment, [this](int row) { ++this->Begin[row + 1]; });
  }
  for (std::size_t row = 1; row < this->Begin.size(); ++row)
  {
    this->Begin[row] += this->Begin[row - 1];
  }
  this->Segments.resize(this->Begin.back());
  std::vector<int> next(this->Begin.begin(), this->Begin.end() - 1);
  for (const Segment& segment : segments)
  {
    visitRows(segment, [&](int row) { this->Segments[next[row]++] = segment; });
  }
}

}
