// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_EpipolarIndex_h
#define freespace_EpipolarIndex_h

#include "EdgeTokens.h"
#include "EpipolarPair.h"

#include <opencv2/core/hal/intrin.hpp>

#include <algorithm>

namespace freespace
{

/// The chains of one image, cut into the pieces between their tokens and sorted by the rows of
/// a pair's rectified frame, so that those which cross an epipolar line are found at once.
class EpipolarIndex
{
public:
  /// Where a piece from one token to the next lies, in rectified pixels.
  struct Span
  {
    float low, high; ///< rows between which it lies
    float u, v;      ///< where it starts
    float slope;     ///< du / dv
  };
  /// What else is known of it.
  struct Segment
  {
    float tangentU, tangentV; ///< unit tangent of the token where it starts
    float uncertainty;        ///< of that token
    int token;
  };

  /// Leaves out what lies more than 70 degrees off the rectified axis, next to the other camera's
  /// direction, and what makes an angle of less than asin(minimumSine) with the rows.
  EpipolarIndex(const EpipolarPair& pair, const EdgeChains& edges, double minimumSine);

  /// Calls visit(segment, u) for all that cross row v at a column u of [near, far) and go down the
  /// rows (their tangent's v is positive) or up.
  template <typename Visitor>
  void VisitRow(double v, bool down, float near, float far, Visitor&& visit) const
  {
    if (!(v >= this->FirstRow && v < this->FirstRow + this->Rows))
    {
      return;
    }
    const int truncated = static_cast<int>(v);
    const int row = truncated - (truncated > v) - static_cast<int>(this->FirstRow);
    const int line = (2 * row + down) * this->Columns;
    const int begin = this->Begin[line + this->ColumnOf(near - this->Widest)];
    const int end = this->Begin[line + this->ColumnOf(far + this->Widest) + 1];
    const cv::v_float32x4 at = cv::v_setall_f32(static_cast<float>(v));
    const cv::v_float32x4 left = cv::v_setall_f32(near), right = cv::v_setall_f32(far);
    float columns[4];
    for (int first = begin & ~3; first < end; first += 4)
    {
      const SpanBlock& spans = this->Spans[first / 4];
      const cv::v_float32x4 u =
        cv::v_load(spans.u) + (at - cv::v_load(spans.v)) * cv::v_load(spans.slope);
      int crossing = cv::v_signmask(
        (cv::v_load(spans.low) <= at) & (at < cv::v_load(spans.high)) & (u >= left) & (u < right));
      crossing &= first < begin ? 15 << (begin - first) : 15;
      crossing &= first + 4 > end ? 15 >> (first + 4 - end) : 15;
      cv::v_store(columns, u);
      for (int k = 0; crossing != 0; ++k, crossing >>= 1)
      {
        if (crossing & 1)
        {
          visit(this->Segments[first + k], columns[k]);
        }
      }
    }
  }

private:
  int ColumnOf(float u) const
  {
    const float column = (u - this->FirstColumn) / CellWidth;
    return static_cast<int>(std::min(std::max(column, 0.0f), this->Columns - 1.0f));
  }

  // Where four segments lie, so that processors compare them at once.
  struct SpanBlock
  {
    float low[4], high[4], u[4], v[4], slope[4];
  };

  // By cell; in that of their start, in each row that they touch.
  std::vector<Segment> Segments;
  std::vector<SpanBlock> Spans;
  std::vector<int> Begin; // of each cell and one past the last: rows twice (up and down) x columns
  int Rows = 0;
  int Columns = 0;
  float FirstRow = 0;
  float FirstColumn = 0;
  float CellWidth = 32; // pixels
  float Widest = 0;     // difference between the columns of a segment's ends
};

}

#endif
