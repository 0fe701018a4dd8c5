// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_EpipolarIndex_h
#define freespace_EpipolarIndex_h

#include "Edges/EdgeTokens.h"
#include "Epipolar/EpipolarPair.h"
#include "Epipolar/PieceGroup.h"

#include <algorithm>
#include <array>

namespace freespace
{

/// A spatial index of the chains of one image: the pieces between tokens, sorted by the rows of a pair's
/// rectified frame, so that those crossing an epipolar line are found in constant time.
class EpipolarIndex
{
public:
  /// The piece of a chain between two tokens, in rectified pixels.
  struct Piece
  {
    float low = 0, high = 0;          ///< rows between which it lies: [low, high)
    float u = 0, v = 0;               ///< where it starts
    float slope = 0;                  ///< du / dv
    float tangentU = 0, tangentV = 0; ///< unit tangent of the token where it starts
    float uncertainty = 0;            ///< of that token

    bool Empty() const { return !(this->low < this->high); }
    bool Crosses(float row) const { return row >= this->low && row < this->high; }
    float ColumnAt(float row) const { return this->u + (row - this->v) * this->slope; }
  };

  /// Empty pieces stand for what lies more than 70 degrees off the rectified axis, next to the other camera's
  /// direction, for what makes an angle of less than asin(minimumSine) with the rows.
  EpipolarIndex(const EpipolarPair& pair, const EdgeChains& edges, double minimumSine);

  /// The piece that starts at a token; empty at the end of a chain.
  const Piece& PieceOf(int token) const { return this->Pieces[token]; }

  /// The token where the piece of `token`'s chain starts that crosses row v, at most `most` pieces
  /// away; -1 when there is none.
  int Follow(int token, float v, int most) const
  {
    const int forward = this->Pieces[token].tangentV > 0 ? 1 : -1;
    for (; most >= 0 && token >= 0 && !this->Pieces[token].Empty(); --most)
    {
      const Piece& piece = this->Pieces[token];
      if (piece.Crosses(v))
      {
        return token;
      }
      token += v < piece.low ? -forward : forward;
    }
    return -1;
  }

  /// Whether the pieces that start at two tokens belong to one chain, at most `most` pieces apart and
  /// none between them empty.
  bool Connects(int token, int other, int most) const
  {
    const int first = std::min(token, other), last = std::max(token, other);
    bool connects = last - first <= most;
    for (int k = first; connects && k < last; ++k)
    {
      connects = !this->Pieces[k].Empty();
    }
    return connects;
  }

  /// What to look for in a row.
  using Search = EdgeSearch;

  /// Calls visit(token, u, cosine, width) for all pieces that cross row v as the search wants; the
  /// width is how far the crossing moves along the row when the edge moves one pixel across, in the
  /// piece's uncertainty.
  template <typename Visitor>
  void VisitRow(double v, const Search& search, Visitor&& visit) const
  {
    if (!(v >= this->FirstRow && v < this->FirstRow + this->Rows))
    {
      return;
    }
    const int row = this->RowOf(v);
    const int begin = this->Begin[row * this->Columns + this->ColumnOf(search.near - this->Widest)];
    const int end =
      this->Begin[row * this->Columns + this->ColumnOf(search.far + this->Widest) + 1];
    const RowSearch wanted = { search, static_cast<float>(v),
      static_cast<float>(v - this->FirstRow - row) };
    std::array<PieceCrossing, PiecesAtATime> found;
    for (int first = begin / PiecesAtATime * PiecesAtATime; first < end; first += PiecesAtATime)
    {
      const int count = FindCrossings(&this->Groups[first / PieceGroup::Size],
        std::max(begin - first, 0), std::min(end - first, PiecesAtATime), wanted, found.data());
      for (int k = 0; k < count; ++k)
      {
        visit(found[k].token, found[k].u, found[k].cosine, found[k].width);
      }
    }
  }

private:
  int RowOf(double v) const
  {
    const int truncated = static_cast<int>(v);
    return truncated - (truncated > v) - static_cast<int>(this->FirstRow);
  }

  int ColumnOf(float u) const
  {
    const float column = (u - this->FirstColumn) / CellWidth;
    return static_cast<int>(std::min(std::max(column, 0.0f), this->Columns - 1.0f));
  }

  int FindBounds();
  template <typename Visitor>
  void VisitCells(Visitor&& visit) const;

  static constexpr int PiecesAtATime = 4 * PieceGroup::Size;

  LargeVector<Piece> Pieces;      // per token
  LargeVector<PieceGroup> Groups; // by cell; in that of their start, in each row that they touch
  std::vector<int> Begin;         // of each cell and one past the last, rows x columns
  int Rows = 0;
  int Columns = 0;
  float FirstRow = 0;
  float FirstColumn = 0;
  float CellWidth = 32; // pixels
  float Widest = 0;     // difference between the columns of a piece's ends
};

}

#endif
