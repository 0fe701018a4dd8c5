// SPDX-License-Identifier: BSD-3-Clause
#include "SideColors.h"

#include <opencv2/core/hal/intrin.hpp>

#include <algorithm>

namespace freespace
{

namespace
{

struct Statistics
{
  double mean = 0;
  double spread = 0;
};

std::array<double, 256> LogColors()
{
  constexpr double dark = 16;
  std::array<double, 256> colors;
  for (int value = 0; value < 256; ++value)
  {
    colors[value] = 255 * std::log1p(value / dark) / std::log1p(255 / dark);
  }
  return colors;
}

Statistics ChannelStatistics(
  const EdgeChains& edges, int channel, const std::array<double, 256>& logColors)
{
  constexpr std::size_t stride = 4; // a sample of the tokens will do
  std::array<std::size_t, 256> histogram{};
  for (std::size_t k = 0; k < edges.tokens.size(); k += stride)
  {
    const EdgeToken& token = edges.tokens[k];
    for (int i = channel; i < EdgeSideColors; i += 3)
    {
      ++histogram[token.bright[i]];
      ++histogram[token.dark[i]];
    }
  }
  double count = 0, sum = 0, squares = 0;
  for (int value = 0; value < 256; ++value)
  {
    count += histogram[value];
    sum += histogram[value] * logColors[value];
    squares += histogram[value] * logColors[value] * logColors[value];
  }
  Statistics statistics;
  if (count > 0)
  {
    statistics.mean = sum / count;
    statistics.spread = std::sqrt(std::max(0.0, squares / count - std::pow(statistics.mean, 2)));
  }
  return statistics;
}

}

SideColors::SideColors(const EdgeChains& image, const EdgeChains& reference)
{
  const std::array<double, 256> logColors = LogColors();
  std::uint8_t table[3][256];
  for (int channel = 0; channel < 3; ++channel)
  {
    const Statistics from = ChannelStatistics(image, channel, logColors);
    const Statistics to = ChannelStatistics(reference, channel, logColors);
    const double gain = std::clamp(to.spread / std::max(from.spread, 1.0), 0.25, 4.0);
    for (int value = 0; value < 256; ++value)
    {
      const double color = to.mean + gain * (logColors[value] - from.mean);
      table[channel][value] = static_cast<std::uint8_t>(std::clamp(color, 0.0, 255.0));
    }
  }
  this->Sides.reserve(image.tokens.size());
  for (const EdgeToken& token : image.tokens)
  {
    std::array<EdgeSide, 2> sides{ token.bright, token.dark };
    for (EdgeSide& side : sides)
    {
      for (int i = 0; i < EdgeSideColors; ++i)
      {
        side[i] = table[i % 3][side[i]];
      }
    }
    this->Sides.push_back(sides);
  }
}

std::array<float, 2> SideColors::Difference(
  int token, const SideColors& other, int otherToken, bool crossed) const
{
  std::array<float, 2> difference;
  for (int side = 0; side < 2; ++side)
  {
    const cv::v_uint8x16 a = cv::v_load(this->Sides[token][side].data());
    const cv::v_uint8x16 b = cv::v_load(other.Sides[otherToken][crossed ? 1 - side : side].data());
    difference[side] = static_cast<float>(cv::v_reduce_sad(a, b)) / EdgeSideColors;
  }
  return difference;
}

}
