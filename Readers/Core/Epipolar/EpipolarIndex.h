// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_EpipolarIndex_h
#define freespace_EpipolarIndex_h

#include "Edges/EdgeTokens.h"
#include "Epipolar/EpipolarPair.h"

#include <opencv2/core/hal/intrin.hpp>

#include <algorithm>

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
  struct Search
  {
    float near, far;          ///< columns [near, far)
    float tangentU, tangentV; ///< of the edge
    float minimumCosine;      ///< of the angle to it
  };

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
    const cv::v_float32x4 at = cv::v_setall_f32(static_cast<float>(v));
    const cv::v_float32x4 down = cv::v_setall_f32(static_cast<float>(v - this->FirstRow - row));
    const cv::v_float32x4 near = cv::v_setall_f32(search.near), far = cv::v_setall_f32(search.far);
    const cv::v_float32x4 tangentU = cv::v_setall_f32(search.tangentU);
    const cv::v_float32x4 tangentV = cv::v_setall_f32(search.tangentV);
    const cv::v_float32x4 least = cv::v_setall_f32(search.minimumCosine);
    float columns[4], cosines[4];
    for (int first = begin & ~3; first < end; first += 4)
    {
      const PieceGroup& group = this->Groups[first / 4];
      const cv::v_float32x4 u = cv::v_load(group.u) + down * cv::v_load(group.slope);
      const cv::v_float32x4 cosine =
        cv::v_abs(tangentU * cv::v_load(group.tangentU) + tangentV * cv::v_load(group.tangentV));
      int found = cv::v_signmask((cv::v_load(group.low) <= at) & (at < cv::v_load(group.high)) &
        (u >= near) & (u < far) & (cosine >= least));
      found &= first < begin ? 15 << (begin - first) : 15;
      found &= first + 4 > end ? 15 >> (first + 4 - end) : 15;
      if (found == 0)
      {
        continue;
      }
      cv::v_store(columns, u);
      cv::v_store(cosines, cosine);
      for (int k = 0; found != 0; ++k, found >>= 1)
      {
        if (found & 1)
        {
          visit(group.token[k], columns[k], cosines[k], group.width[k]);
        }
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

  // Four pieces, so that processors compare them at once.
  struct PieceGroup
  {
    float low[4], high[4];
    float u[4]; // where it crosses the upper border of the cell's row
    float slope[4], tangentU[4], tangentV[4], width[4];
    int token[4];
  };

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
