// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_EpipolarIndex_h
#define freespace_EpipolarIndex_h

#include "EdgeTokens.h"
#include "EpipolarPair.h"

#include <algorithm>

namespace freespace
{

/// The chains of one image, cut into the pieces between their tokens and sorted by the rows of
/// a pair's rectified frame, so that those which cross an epipolar line are found at once.
class EpipolarIndex
{
public:
  /// From one token to the next, in rectified pixels.
  struct Segment
  {
    float low, high;          ///< rows between which it lies
    float u, v;               ///< where it starts
    float slope;              ///< du / dv
    float tangentU, tangentV; ///< unit tangent of the token where it starts
    float uncertainty;        ///< of that token
    int token;
  };

  /// Leaves out what makes an angle of less than asin(minimumSine) with the rows.
  EpipolarIndex(const EpipolarPair& pair, const EdgeChains& edges, double minimumSine);

  /// Calls visit(segment, u) for all that cross row v at a column u of [near, far) and go down the
  /// rows (their tangent's v is positive) or up.
  template <typename Visitor>
  void VisitRow(double v, bool down, float near, float far, Visitor&& visit) const
  {
    const double row = 2 * (std::floor(v) - this->FirstRow) + down;
    if (!(row >= 0) || row + 1 >= static_cast<double>(this->Begin.size()))
    {
      return;
    }
    const auto begin = this->Segments.begin() + this->Begin[static_cast<std::size_t>(row)];
    const auto end = this->Segments.begin() + this->Begin[static_cast<std::size_t>(row) + 1];
    const float at = static_cast<float>(v);
    const auto first = std::lower_bound(begin, end, near - this->Widest,
      [](const Segment& segment, float u) { return segment.u < u; });
    for (auto segment = first; segment != end && segment->u < far + this->Widest; ++segment)
    {
      const float u = segment->u + (at - segment->v) * segment->slope;
      if (segment->low <= at && at < segment->high && u >= near && u < far)
      {
        visit(*segment, u);
      }
    }
  }

private:
  std::vector<Segment> Segments; // by row, direction and u; in each row that they touch
  std::vector<int> Begin;        // per row twice, up and down, and one past the last
  double FirstRow = 0;
  float Widest = 0; // difference between the columns of a segment's ends
};

}

#endif
