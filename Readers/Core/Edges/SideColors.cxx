// SPDX-License-Identifier: BSD-3-Clause
#include "Edges/SideColors.h"

#include <algorithm>
#include <cstring>

namespace freespace
{

namespace
{

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

// Histograms of the channels.
using Histograms = std::array<std::array<int, 256>, 3>;

Histograms ColorHistograms(const EdgeChains& edges)
{
  constexpr std::size_t stride = 4; // a sample of the tokens will do
  Histograms histograms{};
  for (std::size_t k = 0; k < edges.tokens.size(); k += stride)
  {
    const EdgeToken& token = edges.tokens[k];
    for (const EdgeSide& side : { token.bright, token.dark })
    {
      for (const EdgeColor& color : side)
      {
        for (int channel = 0; channel < 3; ++channel)
        {
          ++histograms[channel][color[channel]];
        }
      }
    }
  }
  return histograms;
}

ColorStatistics::Channel ChannelStatistics(
  const std::array<int, 256>& histogram, const std::array<double, 256>& logColors)
{
  double count = 0, sum = 0, squares = 0;
  for (int value = 0; value < 256; ++value)
  {
    count += histogram[value];
    sum += histogram[value] * logColors[value];
    squares += histogram[value] * logColors[value] * logColors[value];
  }
  ColorStatistics::Channel statistics;
  if (count > 0)
  {
    statistics.mean = sum / count;
    statistics.spread = std::sqrt(std::max(0.0, squares / count - std::pow(statistics.mean, 2)));
  }
  return statistics;
}

}

ColorStatistics::ColorStatistics(const EdgeChains& edges)
{
  const std::array<double, 256> logColors = LogColors();
  const Histograms histograms = ColorHistograms(edges);
  for (int channel = 0; channel < 3; ++channel)
  {
    this->Channels[channel] = ChannelStatistics(histograms[channel], logColors);
  }
}

SideColors::SideColors(
  const EdgeChains& image, const ColorStatistics& statistics, const ColorStatistics& reference)
{
  const std::array<double, 256> logColors = LogColors();
  std::uint32_t table[3][256]; // in its byte of a colour
  for (int channel = 0; channel < 3; ++channel)
  {
    const ColorStatistics::Channel& own = statistics.Channels[channel];
    const ColorStatistics::Channel& wanted = reference.Channels[channel];
    const double gain = std::clamp(wanted.spread / std::max(own.spread, 1.0), 0.25, 4.0);
    for (int value = 0; value < 256; ++value)
    {
      const double color = wanted.mean + gain * (logColors[value] - own.mean);
      EdgeColor alone{};
      alone[channel] = static_cast<std::uint8_t>(std::clamp(color, 0.0, 255.0));
      std::memcpy(&table[channel][value], alone.data(), alone.size());
    }
  }
  this->Sides.reserve(image.tokens.size());
  for (const EdgeToken& token : image.tokens)
  {
    std::array<EdgeSide, 2> sides{ token.bright, token.dark };
    for (EdgeSide& side : sides)
    {
      for (EdgeColor& color : side)
      {
        const std::uint32_t all = table[0][color[0]] | table[1][color[1]] | table[2][color[2]];
        std::memcpy(color.data(), &all, color.size());
      }
    }
    this->Sides.push_back(sides);
  }
}

}
