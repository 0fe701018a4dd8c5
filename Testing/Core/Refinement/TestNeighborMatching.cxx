// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/NeighborMatching.h"

#include "Common/Error.h"

#include <gtest/gtest.h>

using namespace freespace;

TEST(NeighborMatching, ManyImagesKeepFewerTracksOfEach)
{
  const NeighborMatchingOptions options;
  EXPECT_EQ(options.TracksOfEach(0), 400u);
  EXPECT_EQ(options.TracksOfEach(30), 400u);
  EXPECT_EQ(options.TracksOfEach(48), 250u);
  EXPECT_EQ(options.TracksOfEach(120), 100u);
  EXPECT_EQ(options.TracksOfEach(10000), 100u);
}

TEST(NeighborMatching, KeepsOneTrackAtLeast)
{
  NeighborMatchingOptions options;
  options.tracksPerImage = 1;
  EXPECT_EQ(options.TracksOfEach(1000000), 1u);
}

TEST(NeighborMatching, OptionsOutOfRange)
{
  const auto isRefused = [](const auto& change)
  {
    NeighborMatchingOptions options;
    change(options);
    try
    {
      options.Check();
    }
    catch (const Error&)
    {
      return true;
    }
    return false;
  };
  EXPECT_FALSE(isRefused([](auto&) {}));
  EXPECT_TRUE(isRefused([](auto& options) { options.neighbors = 1; }));
  EXPECT_TRUE(isRefused([](auto& options) { options.tolerance = 0; }));
  EXPECT_TRUE(isRefused([](auto& options) { options.tokensPerImage = 0; }));
  EXPECT_TRUE(isRefused([](auto& options) { options.tracksPerImage = 0; }));
  EXPECT_TRUE(isRefused([](auto& options) { options.tracks = 0; }));
}
