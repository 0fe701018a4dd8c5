// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SideColors_h
#define freespace_SideColors_h

#include "Edges/EdgeTokens.h"
#include "Common/VectorClones.h"

#include <cstdlib>

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
    const std::array<EdgeSide, 2>& own = this->Sides[token];
    const std::array<EdgeSide, 2>& others = other.Sides[otherToken];
    // One after the other: in a loop over both sides GCC unrolls that over the bytes instead of vectorizing it.
    return { Difference(own[0], others[crossed]), Difference(own[1], others[!crossed]) };
  }

  /// Before the token is compared.
  void Prefetch(int token) const { FREESPACE_PREFETCH(&this->Sides[token]); }

private:
  static float Difference(const EdgeSide& own, const EdgeSide& others)
  {
    const auto* ownBytes = reinterpret_cast<const std::uint8_t*>(own.data());
    const auto* otherBytes = reinterpret_cast<const std::uint8_t*>(others.data());
    int sum = 0;
    for (int k = 0; k < static_cast<int>(sizeof(EdgeSide)); ++k)
    {
      sum += std::abs(ownBytes[k] - otherBytes[k]);
    }
    return static_cast<float>(sum) / (3 * own.size());
  }

  LargeVector<std::array<EdgeSide, 2>> Sides; // per token
};

}

#endif
