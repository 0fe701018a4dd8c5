// SPDX-License-Identifier: BSD-3-Clause
#include "Common/ParseNumber.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

using namespace freespace;

TEST(ParseNumber, WholeTextsAreNumbers)
{
  EXPECT_EQ(ParseNumber<int>("42"), 42);
  EXPECT_EQ(ParseNumber<int>("-42"), -42);
  EXPECT_EQ(ParseNumber<int>("+42"), 42);
  EXPECT_EQ(ParseNumber<double>("1e3"), 1000.0);
  EXPECT_EQ(ParseNumber<double>("+.5"), 0.5);
  EXPECT_EQ(ParseNumber<double>("0.1"), 0.1) << "correctly rounded";
  EXPECT_EQ(ParseNumber<std::uint64_t>("18446744073709551615"), UINT64_MAX);
  EXPECT_TRUE(std::isnan(ParseNumber<double>("nan").value()));
  EXPECT_EQ(ParseNumber<double>("inf"), std::numeric_limits<double>::infinity());
}

TEST(ParseNumber, OtherTextsAreNot)
{
  for (const char* text : { "", " ", "+", "-", "+-5", "++5", "x", "5x", "5 ", " 5", "1,5", "0x10" })
  {
    EXPECT_FALSE(ParseNumber<int>(text)) << text;
    EXPECT_FALSE(ParseNumber<double>(text)) << text;
  }
  EXPECT_FALSE(ParseNumber<int>("1.5"));
  EXPECT_FALSE(ParseNumber<unsigned int>("-1"));
}

TEST(ParseNumber, WhatIsOutOfRangeIsRefused)
{
  EXPECT_EQ(ParseNumber<int>("2147483647"), 2147483647);
  EXPECT_FALSE(ParseNumber<int>("2147483648"));
  EXPECT_FALSE(ParseNumber<double>("1e400"));
}
