// SPDX-License-Identifier: BSD-3-Clause
#include "Help/Suggestion.h"

#include <gtest/gtest.h>

using namespace freespace;

TEST(ClosestWord, IsTheOneThatWasMeant)
{
  const std::vector<std::string> known = { "--cells", "--region", "--no-fit", "-o", "--output" };
  EXPECT_EQ(ClosestWord("--cels", known), "--cells");
  EXPECT_EQ(ClosestWord("--clels", known), "--cells");
  EXPECT_EQ(ClosestWord("-region", known), "--region");
  EXPECT_EQ(ClosestWord("--nofit", known), "--no-fit");
  EXPECT_EQ(ClosestWord("--ouptut", known), "--output");
}

TEST(ClosestWord, IsNoneWhereNothingIsNear)
{
  EXPECT_EQ(ClosestWord("--colour", { "--cells", "--region", "-o" }), "");
  EXPECT_EQ(ClosestWord("", { "--cells", "-o" }), "");
  EXPECT_EQ(ClosestWord("x", { "-o" }), ""); // a letter for a letter is no likeness
  EXPECT_EQ(ClosestWord("--cells", {}), "");
}
