// SPDX-License-Identifier: BSD-3-Clause
#include "Help/ManPage.h"

#include <gtest/gtest.h>

using namespace freespace;

TEST(ManPage, EscapesWhatRoffWouldRead)
{
  CommandText text;
  text.name = "program";
  text.description = ".a \\ b-c";
  const std::string page = ManPage(text, "1.0");
  EXPECT_NE(page.find("\\&.a \\e b\\-c"), std::string::npos);
}
