// SPDX-License-Identifier: BSD-3-Clause
#include "Edges/SideColors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace freespace;

namespace
{

EdgeSide Uniform(int blue, int green, int red)
{
  EdgeColor color{};
  color[0] = static_cast<std::uint8_t>(blue);
  color[1] = static_cast<std::uint8_t>(green);
  color[2] = static_cast<std::uint8_t>(red);
  EdgeSide side;
  side.fill(color);
  return side;
}

EdgeSide Gray(int level)
{
  return Uniform(level, level, level);
}

EdgeChains ChainOf(const std::vector<std::array<EdgeSide, 2>>& sides)
{
  EdgeChains chains;
  for (const auto& [bright, dark] : sides)
  {
    EdgeToken token{};
    token.position = { 0, 0 };
    token.tangent = { 1, 0 };
    token.bright = bright;
    token.dark = dark;
    chains.tokens.push_back(token);
  }
  chains.begin.push_back(static_cast<int>(sides.size()));
  return chains;
}

SideColors Own(const EdgeChains& chains)
{
  const ColorStatistics statistics(chains);
  return SideColors(chains, statistics, statistics);
}

// The definition: 0 .. 255 to the same range, logarithmic but in the dark.
double LogColor(int value)
{
  return 255 * std::log1p(value / 16.0) / std::log1p(255 / 16.0);
}

}

TEST(SideColors, DifferencesInClosedForm)
{
  const EdgeChains chains = ChainOf({ { Gray(255), Gray(0) }, { Gray(200), Gray(50) } });
  const SideColors colors = Own(chains);
  const auto same = colors.Difference(0, colors, 0, false);
  EXPECT_EQ(same[0], 0);
  EXPECT_EQ(same[1], 0);
  const auto crossed = colors.Difference(0, colors, 0, true);
  EXPECT_NEAR(crossed[0], 255, 1);
  EXPECT_NEAR(crossed[1], 255, 1);
  const auto other = colors.Difference(0, colors, 1, false);
  EXPECT_NEAR(other[0], 255 - LogColor(200), 1);
  EXPECT_NEAR(other[1], LogColor(50), 1);
}

TEST(SideColors, OneChannelCountsAThird)
{
  const EdgeChains chains =
    ChainOf({ { Uniform(255, 0, 255), Gray(0) }, { Uniform(0, 0, 255), Gray(0) } });
  const SideColors colors = Own(chains);
  EXPECT_NEAR(colors.Difference(0, colors, 1, false)[0], 255 / 3.0, 1);
}

TEST(SideColors, DifferencesAgreeWithTheDefinition)
{
  std::mt19937 random(5);
  std::uniform_int_distribution<int> value(0, 255);
  std::vector<std::array<EdgeSide, 2>> sides(80);
  for (auto& token : sides)
  {
    for (EdgeSide& side : token)
    {
      for (EdgeColor& color : side)
      {
        color = { static_cast<std::uint8_t>(value(random)),
          static_cast<std::uint8_t>(value(random)), static_cast<std::uint8_t>(value(random)), 0 };
      }
    }
  }
  const SideColors colors = Own(ChainOf(sides));
  for (int a = 0; a < 80; ++a)
  {
    const int b = (7 * a + 3) % 80;
    for (const bool crossed : { false, true })
    {
      const auto difference = colors.Difference(a, colors, b, crossed);
      for (int side = 0; side < 2; ++side)
      {
        double sum = 0;
        for (int place = 0; place < 4; ++place)
        {
          for (int channel = 0; channel < 3; ++channel)
          {
            sum += std::abs(LogColor(sides[a][side][place][channel]) -
              LogColor(sides[b][crossed ? 1 - side : side][place][channel]));
          }
        }
        EXPECT_NEAR(difference[side], sum / 12, 1.001) << "levels are rounded down";
      }
    }
  }
}

// Another exposure of the same scene: the mean and the spread of the logarithms are brought to those of
// the reference.
TEST(SideColors, AnotherExposureIsTakenOut)
{
  std::mt19937 random(6);
  std::uniform_int_distribution<int> value(40, 250);
  std::vector<std::array<EdgeSide, 2>> bright, dark;
  for (int i = 0; i < 400; ++i)
  {
    const int a = value(random), b = value(random);
    bright.push_back({ Gray(a), Gray(b) });
    dark.push_back({ Gray(a / 2), Gray(b / 2) });
  }
  const EdgeChains reference = ChainOf(bright), other = ChainOf(dark);
  const ColorStatistics ofReference(reference), ofOther(other);
  const SideColors first(reference, ofReference, ofReference);
  const SideColors leveled(other, ofOther, ofReference), raw(other, ofOther, ofOther);
  double before = 0, after = 0;
  for (int i = 0; i < 400; ++i)
  {
    before += first.Difference(i, raw, i, false)[0] / 400;
    after += first.Difference(i, leveled, i, false)[0] / 400;
  }
  EXPECT_GT(before, 40);
  EXPECT_LT(after, 4);
}

TEST(SideColors, ImageOfOneColor)
{
  const EdgeChains reference = ChainOf({ { Gray(200), Gray(200) } });
  const EdgeChains other = ChainOf({ { Gray(20), Gray(20) } });
  const ColorStatistics ofReference(reference), ofOther(other);
  EXPECT_NEAR(ofOther.Channels[0].mean, LogColor(20), 1e-9);
  EXPECT_NEAR(ofOther.Channels[0].spread, 0, 1e-5) << "no spread to divide by";
  const SideColors first(reference, ofReference, ofReference);
  const SideColors second(other, ofOther, ofReference);
  EXPECT_LE(first.Difference(0, second, 0, false)[0], 1);
}

TEST(SideColors, ImageWithoutEdges)
{
  const ColorStatistics statistics{ EdgeChains() };
  for (const ColorStatistics::Channel& channel : statistics.Channels)
  {
    EXPECT_EQ(channel.mean, 0);
    EXPECT_EQ(channel.spread, 0);
  }
  Own(EdgeChains());
}
