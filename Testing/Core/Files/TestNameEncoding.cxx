// SPDX-License-Identifier: BSD-3-Clause
#include "Files/NameEncoding.h"

#include <gtest/gtest.h>

#include <random>

using namespace freespace;

TEST(NameEncoding, NamesInUtf8Stay)
{
  for (const std::string name :
    { "", "a b.jpg", "caf\xc3\xa9", "\xe6\x97\xa5\xe6\x9c\xac", "\xf0\x9f\x93\xb7" })
  {
    EXPECT_EQ(Utf8FromName(name), name);
    EXPECT_EQ(NameFromUtf8(name), name);
  }
}

TEST(NameEncoding, Latin1)
{
  EXPECT_EQ(Utf8FromName("caf\xe9"
                         "0.jpg"),
    "caf\xee\xbf\xa9"
    "0.jpg")
    << "U+EFE9";
}

TEST(NameEncoding, EveryNameComesBackAndHasNoControls)
{
  std::mt19937 random(3);
  for (int run = 0; run < 20000; ++run)
  {
    std::string name(random() % 12, ' ');
    for (char& c : name)
    {
      // Also the bytes of the escapes themselves.
      c = static_cast<char>(run % 2 ? random() : (random() % 4 + 0xEC) ^ (random() % 2 ? 0x50 : 0));
    }
    const std::string text = Utf8FromName(name);
    EXPECT_EQ(NameFromUtf8(text), name);
    EXPECT_EQ(
      Utf8FromName(text).find_first_of(std::string("\n\t\x01\x7f\0", 5)), std::string::npos);
  }
}

TEST(NameEncoding, Printable)
{
  EXPECT_EQ(Printable("a\nb\tc\x1b[31m\x7f d"), "a\\nb\\tc\\x1b[31m\\x7f d");
  EXPECT_EQ(Printable("caf\xc3\xa9"), "caf\xc3\xa9");
}
