// SPDX-License-Identifier: BSD-3-Clause
#include "EpipolarIndex.h"

#include <algorithm>
#include <limits>

namespace freespace
{

namespace
{

std::vector<EpipolarIndex::Piece> RectifiedPieces(
  const EpipolarPair& pair, const EdgeChains& edges, double minimumSine)
{
  constexpr double leastScale = 0.34; // cosine of 70 degrees
  std::vector<EpipolarIndex::Piece> pieces(edges.tokens.size());
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
        EpipolarIndex::Piece& piece = pieces[i];
        piece.low = static_cast<float>(std::min(ray.v, next.v));
        piece.high = static_cast<float>(std::max(ray.v, next.v));
        piece.u = static_cast<float>(ray.u);
        piece.v = static_cast<float>(ray.v);
        piece.slope = static_cast<float>((next.u - ray.u) / (next.v - ray.v));
        piece.tangentU = static_cast<float>(tangent.x());
        piece.tangentV = static_cast<float>(tangent.y());
        piece.uncertainty = static_cast<float>(token.Uncertainty());
      }
    }
  }
  return pieces;
}

}

// Calls visit(cell, piece) for each row that a piece touches.
template <typename Visitor>
void EpipolarIndex::VisitCells(Visitor&& visit) const
{
  for (const Piece& piece : this->Pieces)
  {
    if (!piece.Empty())
    {
      const int first = static_cast<int>(std::floor(piece.low) - this->FirstRow);
      const int last = static_cast<int>(std::floor(piece.high) - this->FirstRow);
      const int column = this->ColumnOf(piece.u);
      for (int row = first; row <= last; ++row)
      {
        visit((2 * row + (piece.tangentV > 0)) * this->Columns + column, piece);
      }
    }
  }
}

EpipolarIndex::EpipolarIndex(const EpipolarPair& pair, const EdgeChains& edges, double minimumSine)
{
  this->Pieces = RectifiedPieces(pair, edges, minimumSine);
  const int count = this->FindBounds();
  if (count == 0)
  {
    return;
  }
  const std::size_t cells = static_cast<std::size_t>(2) * this->Rows * this->Columns;
  this->Begin.assign(cells + 1, 0);
  this->VisitCells([this](int cell, const Piece&) { ++this->Begin[cell + 1]; });
  for (std::size_t cell = 0; cell < cells; ++cell)
  {
    this->Begin[cell + 1] += this->Begin[cell];
  }
  this->Blocks.resize((this->Begin.back() + 3) / 4);
  std::vector<int> next(this->Begin.begin(), this->Begin.end() - 1);
  this->VisitCells(
    [&](int cell, const Piece& piece)
    {
      const int i = next[cell]++ % 4;
      PieceBlock& block = this->Blocks[(next[cell] - 1) / 4];
      block.low[i] = piece.low;
      block.high[i] = piece.high;
      block.u[i] = piece.u;
      block.v[i] = piece.v;
      block.slope[i] = piece.slope;
      block.tangentU[i] = piece.tangentU;
      block.tangentV[i] = piece.tangentV;
      block.token[i] = static_cast<int>(&piece - this->Pieces.data());
    });
}

// Where the pieces lie and how wide a cell is; returns how many there are.
int EpipolarIndex::FindBounds()
{
  constexpr float most = std::numeric_limits<float>::max();
  float low = most, high = -most, left = most, right = -most;
  int count = 0;
  for (const Piece& piece : this->Pieces)
  {
    if (!piece.Empty())
    {
      low = std::min(low, piece.low);
      high = std::max(high, piece.high);
      left = std::min(left, piece.u);
      right = std::max(right, piece.u);
      this->Widest = std::max(this->Widest, std::abs(piece.slope) * (piece.high - piece.low));
      ++count;
    }
  }
  if (count > 0)
  {
    this->FirstRow = std::floor(low);
    this->FirstColumn = left;
    this->Rows = static_cast<int>(std::floor(high) - this->FirstRow) + 1;
    // At most a few cells for each piece, however the images are stretched.
    const float cells = 4.0f * static_cast<float>(count);
    this->CellWidth = std::max(this->CellWidth, (right - left) * 2 * this->Rows / cells);
    this->Columns = static_cast<int>((right - left) / this->CellWidth) + 1;
  }
  return count;
}

}
