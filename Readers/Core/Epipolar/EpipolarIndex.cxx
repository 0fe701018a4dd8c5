// SPDX-License-Identifier: BSD-3-Clause
#include "Epipolar/EpipolarIndex.h"

#include "Common/GroupedLists.h"
#include "Epipolar/EpipolarRays.h"

#include <algorithm>
#include <limits>

namespace freespace
{

namespace
{

LargeVector<EpipolarIndex::Piece> RectifiedPieces(
  const EpipolarPair& pair, const EdgeChains& edges, double minimumSine)
{
  constexpr double leastScale = 0.34; // cosine of 70 degrees
  LargeVector<EpipolarIndex::Piece> pieces(edges.tokens.size());
  EpipolarRays rays;
  for (std::size_t chain = 0; chain < edges.NumberOfChains(); ++chain)
  {
    const int begin = edges.begin[chain], count = edges.begin[chain + 1] - begin;
    rays.Compute(pair.OtherHomography(), &edges.tokens[begin], count);
    for (int k = 0; k + 1 < count; ++k)
    {
      const double rows = rays.v[k + 1] - rays.v[k];
      if (rays.scale[k] > leastScale && rays.scale[k + 1] > leastScale && rows != 0 &&
        std::abs(rays.tangentV[k]) >= minimumSine)
      {
        EpipolarIndex::Piece& piece = pieces[begin + k];
        piece.low = static_cast<float>(std::min(rays.v[k], rays.v[k + 1]));
        piece.high = static_cast<float>(std::max(rays.v[k], rays.v[k + 1]));
        piece.u = static_cast<float>(rays.u[k]);
        piece.v = static_cast<float>(rays.v[k]);
        piece.slope = static_cast<float>((rays.u[k + 1] - rays.u[k]) / rows);
        piece.tangentU = static_cast<float>(rays.tangentU[k]);
        piece.tangentV = static_cast<float>(rays.tangentV[k]);
        piece.uncertainty = static_cast<float>(edges.tokens[begin + k].Uncertainty());
      }
    }
  }
  return pieces;
}

}

// Calls visit(row, column, piece) for each row that a piece touches.
template <typename Visitor>
void EpipolarIndex::VisitCells(Visitor&& visit) const
{
  for (const Piece& piece : this->Pieces)
  {
    if (!piece.Empty())
    {
      const int first = this->RowOf(piece.low), last = this->RowOf(piece.high);
      const int column = this->ColumnOf(piece.u);
      for (int row = first; row <= last; ++row)
      {
        visit(row, column, piece);
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
  const std::size_t cells = static_cast<std::size_t>(this->Rows) * this->Columns;
  this->Begin = BeginOfLists<int>(cells,
    [this](const auto& add)
    {
      this->VisitCells([&](int row, int column, const Piece&)
        { add(static_cast<std::size_t>(row) * this->Columns + column); });
    });
  this->Groups.resize((this->Begin.back() + PieceGroup::Size - 1) / PieceGroup::Size);
  std::vector<int> next(this->Begin.begin(), this->Begin.end() - 1);
  this->VisitCells(
    [&](int row, int column, const Piece& piece)
    {
      const int place = next[row * this->Columns + column]++, i = place % PieceGroup::Size;
      PieceGroup& group = this->Groups[place / PieceGroup::Size];
      group.low[i] = piece.low;
      group.high[i] = piece.high;
      group.u[i] = piece.ColumnAt(this->FirstRow + static_cast<float>(row));
      group.slope[i] = piece.slope;
      group.tangentU[i] = piece.tangentU;
      group.tangentV[i] = piece.tangentV;
      group.width[i] = piece.uncertainty / std::abs(piece.tangentV);
      group.token[i] = static_cast<int>(&piece - this->Pieces.data());
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
    this->CellWidth = std::max(this->CellWidth, (right - left) * this->Rows / cells);
    this->Columns = static_cast<int>((right - left) / this->CellWidth) + 1;
  }
  return count;
}

}
