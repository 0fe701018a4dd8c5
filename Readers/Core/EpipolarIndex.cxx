// SPDX-License-Identifier: BSD-3-Clause
#include "EpipolarIndex.h"

#include <algorithm>
#include <limits>

namespace freespace
{

namespace
{

struct RectifiedSegment
  : EpipolarIndex::Span
  , EpipolarIndex::Segment
{
};

std::vector<RectifiedSegment> RectifiedSegments(
  const EpipolarPair& pair, const EdgeChains& edges, double minimumSine)
{
  constexpr double leastScale = 0.34; // cosine of 70 degrees
  std::vector<RectifiedSegment> segments;
  segments.reserve(edges.tokens.size());
  for (std::size_t chain = 0; chain < edges.NumberOfChains(); ++chain)
  {
    EpipolarPair::Ray next = pair.FromOther(edges.tokens[edges.begin[chain]].position);
    for (int i = edges.begin[chain]; i + 1 < edges.begin[chain + 1]; ++i)
    {
      const EpipolarPair::Ray ray = next;
      next = pair.FromOther(edges.tokens[i + 1].position);
      if (!(ray.scale > leastScale) || !(next.scale > leastScale) || ray.v == next.v)
      {
        continue;
      }
      const EdgeToken& token = edges.tokens[i];
      const Eigen::Vector2d tangent = (pair.OtherJacobian(ray) * token.tangent).normalized();
      if (std::abs(tangent.y()) >= minimumSine)
      {
        segments.push_back(
          { { static_cast<float>(std::min(ray.v, next.v)),
              static_cast<float>(std::max(ray.v, next.v)), static_cast<float>(ray.u),
              static_cast<float>(ray.v), static_cast<float>((next.u - ray.u) / (next.v - ray.v)) },
            { static_cast<float>(tangent.x()), static_cast<float>(tangent.y()),
              static_cast<float>(token.Uncertainty()), i } });
      }
    }
  }
  return segments;
}

}

EpipolarIndex::EpipolarIndex(const EpipolarPair& pair, const EdgeChains& edges, double minimumSine)
{
  const std::vector<RectifiedSegment> segments = RectifiedSegments(pair, edges, minimumSine);
  if (segments.empty())
  {
    return;
  }
  constexpr float most = std::numeric_limits<float>::max();
  float low = most, high = -most, left = most, right = -most;
  for (const RectifiedSegment& segment : segments)
  {
    low = std::min(low, segment.low);
    high = std::max(high, segment.high);
    left = std::min(left, segment.u);
    right = std::max(right, segment.u);
    this->Widest = std::max(this->Widest, std::abs(segment.slope) * (segment.high - segment.low));
  }
  this->FirstRow = std::floor(low);
  this->FirstColumn = left;
  this->Rows = static_cast<int>(std::floor(high) - this->FirstRow) + 1;
  // At most a few cells for each segment, however the images are stretched.
  const float cells = 4.0f * static_cast<float>(segments.size());
  this->CellWidth = std::max(this->CellWidth, (right - left) * 2 * this->Rows / cells);
  this->Columns = static_cast<int>((right - left) / CellWidth) + 1;
  const auto visitCells = [this](const RectifiedSegment& segment, auto&& visit)
  {
    const int first = static_cast<int>(std::floor(segment.low) - this->FirstRow);
    const int last = static_cast<int>(std::floor(segment.high) - this->FirstRow);
    const int column = this->ColumnOf(segment.u);
    for (int row = first; row <= last; ++row)
    {
      visit((2 * row + (segment.tangentV > 0)) * this->Columns + column);
    }
  };
  this->Begin.assign(static_cast<std::size_t>(2) * this->Rows * this->Columns + 1, 0);
  for (const RectifiedSegment& segment : segments)
  {
    visitCells(segment, [this](int cell) { ++this->Begin[cell + 1]; });
  }
  for (std::size_t cell = 1; cell < this->Begin.size(); ++cell)
  {
    this->Begin[cell] += this->Begin[cell - 1];
  }
  const std::size_t count = this->Begin.back();
  this->Segments.resize(count);
  this->Spans.resize((count + 3) / 4);
  std::vector<int> next(this->Begin.begin(), this->Begin.end() - 1);
  for (const RectifiedSegment& segment : segments)
  {
    visitCells(segment,
      [&](int cell)
      {
        const int i = next[cell]++;
        this->Segments[i] = segment;
        SpanBlock& spans = this->Spans[i / 4];
        spans.low[i % 4] = segment.low;
        spans.high[i % 4] = segment.high;
        spans.u[i % 4] = segment.u;
        spans.v[i % 4] = segment.v;
        spans.slope[i % 4] = segment.slope;
      });
  }
}

}
