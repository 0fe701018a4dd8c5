// SPDX-License-Identifier: BSD-3-Clause
#include "Tables/TextTable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace freespace;

TEST(TextTable, AlignsTheFirstColumnLeftAndTheOthersRight)
{
  TextTable table;
  table.Add({ "", "a", "long head" });
  table.Add({ "first", "12", "3" });
  table.Add({ "2nd", "", "" });
  EXPECT_EQ(table.Text(),
    "        a  long head\n"
    "first  12          3\n"
    "2nd\n");
}

TEST(TextTable, CountsCharactersNotBytes)
{
  TextTable table;
  table.Add({ "\xC3\xA4", "1" }); // an umlaut of two bytes
  table.Add({ "b", "1" });
  EXPECT_EQ(table.Text(), "\xC3\xA4  1\nb  1\n");
}

TEST(TextTable, ControlCharactersAreEscaped)
{
  TextTable table;
  table.Add({ "a\033[31m\nb" });
  const std::string text = table.Text();
  EXPECT_EQ(text.find('\033'), std::string::npos);
  EXPECT_EQ(text.find('\n'), text.size() - 1) << "one line";
}

TEST(TextTable, WithoutRowsIsEmpty)
{
  EXPECT_EQ(TextTable().Text(), "");
}

TEST(CsvCell, IsQuotedWhereItHasToBe)
{
  EXPECT_EQ(CsvCell("plain word"), "plain word");
  EXPECT_EQ(CsvCell("a,b"), "\"a,b\"");
  EXPECT_EQ(CsvCell("a \"b\""), "\"a \"\"b\"\"\"");
  EXPECT_EQ(CsvCell("a\nb"), "\"a\nb\"");
  EXPECT_EQ(CsvCell(""), "");
}

TEST(NumberText, HasSignificantDigits)
{
  EXPECT_EQ(NumberText(0), "0");
  EXPECT_EQ(NumberText(0.5), "0.5");
  EXPECT_EQ(NumberText(123.456), "123.5");
  EXPECT_EQ(NumberText(123.456, 2), "1.2e+02");
  EXPECT_EQ(NumberText(-0.000123456), "-0.0001235");
  EXPECT_EQ(NumberText(std::numeric_limits<double>::infinity()), "inf");
}
