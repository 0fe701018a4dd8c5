// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SideColors_h
#define freespace_SideColors_h

#include "Edges/EdgeTokens.h"
#include "Edges/VectorClones.h"

#include <opencv2/core/hal/intrin.hpp>

namespace freespace
{

/// Mean and spread of the colours beside the edges of an image, in logarithms (see SideColors).
struct ColorStatistics
{
  explicit ColorStatistics(const EdgeChains& edges);

  struct Channel
  {
    double mean = 0, spread = 0;
  };
  std::array<Channel, 3> Channels;
};

/// The colours on both sides of the edges of an image, prepared for comparison.
///
/// Colours are compared in logarithms, 0 .. 255 brought to the same range, where a change of
/// illumination is an offset; the dark end, which is mostly noise, is compressed less than a
/// true logarithm would. The images of a cluster show about the same scene: their mean and spread are
/// normalized to those of the reference, channel by channel, which compensates for the exposure.
class SideColors
{
public:
  /// The colours of an image with these statistics as the reference has them.
  SideColors(
    const EdgeChains& image, const ColorStatistics& statistics, const ColorStatistics& reference);

  /// Mean absolute differences, 0 .. 255, between the bright sides and between the dark ones;
  /// crossed: of the bright side to the other's dark one, and the other way round.
  std::array<float, 2> Difference(
    int token, const SideColors& other, int otherToken, bool crossed) const
  {
    std::array<float, 2> difference;
    for (int side = 0; side < 2; ++side)
    {
      const EdgeSide& own = this->Sides[token][side];
      const EdgeSide& others = other.Sides[otherToken][crossed ? 1 - side : side];
      const unsigned sum =
        cv::v_reduce_sad(cv::v_load(own.front().data()), cv::v_load(others.front().data()));
      difference[side] = static_cast<float>(sum) / (3 * own.size());
    }
    return difference;
  }

  /// Before the token is compared.
  void Prefetch(int token) const { FREESPACE_PREFETCH(&this->Sides[token]); }

private:
  LargeVector<std::array<EdgeSide, 2>> Sides; // per token
};

}

#endif
