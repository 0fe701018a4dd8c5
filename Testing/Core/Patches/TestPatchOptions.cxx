// SPDX-License-Identifier: BSD-3-Clause
#include "Patches/PatchOptions.h"

#include "Common/Error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace freespace;

TEST(PatchOptions, Range)
{
  EXPECT_NO_THROW(PatchOptions().Check());
  const auto fails = [](auto change)
  {
    PatchOptions options;
    change(options);
    EXPECT_THROW(options.Check(), Error);
  };
  fails([](PatchOptions& o) { o.radius = 1; });
  fails([](PatchOptions& o) { o.radius = 8; });
  fails([](PatchOptions& o) { o.spacing = 0; });
  fails([](PatchOptions& o) { o.seedStep = 0; });
  fails([](PatchOptions& o) { o.iterations = 0; });
  fails([](PatchOptions& o) { o.leastPartners = 0; });
  fails([](PatchOptions& o) { o.leastCorrelation = 1; });
  fails([](PatchOptions& o) { o.leastContrast = 0; });
  fails([](PatchOptions& o) { o.mostShift = std::nan(""); });
  fails([](PatchOptions& o) { o.mostDeviation = -1; });
  fails([](PatchOptions& o) { o.mostRoughness = std::numeric_limits<double>::infinity(); });
}
