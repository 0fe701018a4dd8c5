// SPDX-License-Identifier: BSD-3-Clause
#include "Text/NumberTable.h"

#include "Common/Error.h"
#include "Support/Core/ErrorOf.h"

#include <gtest/gtest.h>

#include <sstream>

using namespace freespace;

namespace
{

std::vector<double> Read(const std::string& text, std::size_t columns = 3)
{
  std::istringstream file(text);
  return ReadNumberTable(file, "points", columns, [] {});
}

std::string TableErrorOf(const std::string& text)
{
  return ErrorOf([&text] { (void)Read(text); });
}

}

TEST(NumberTable, RowsAreSeparatedByCommasOrBlanks)
{
  const std::vector<double> numbers = { 1, 2, 3, -4.5, 5e1, 6 };
  EXPECT_EQ(Read("1,2,3\n-4.5,5e1,6\n"), numbers);
  EXPECT_EQ(Read("1 2\t3\n-4.5, 5e1 ,6"), numbers) << "without an end of the last line";
  EXPECT_EQ(Read("\xEF\xBB\xBF"
                 "1,2,3\r\n\r\n-4.5,5e1,6\r\n"),
    numbers)
    << "as Windows writes it";
}

TEST(NumberTable, AHeaderIsSkippedOnce)
{
  EXPECT_EQ(Read("x,y,z\n1,2,3\n"), (std::vector<double>{ 1, 2, 3 }));
  EXPECT_EQ(Read("\n# x y z\n1,2,3\n"), (std::vector<double>{ 1, 2, 3 }));
  EXPECT_TRUE(Read("x,y,z\n").empty()) << "a table without rows";
  EXPECT_EQ(TableErrorOf("x,y,z\nx,y,z\n1,2,3\n"), "'points' has no 3 numbers in line 2.");
  EXPECT_EQ(TableErrorOf("1e3;2;3\n"), "'points' has no 3 numbers in line 1.")
    << "no header: it begins with a number";
}

TEST(NumberTable, OtherRowsAreErrorsThatNameTheLine)
{
  EXPECT_EQ(TableErrorOf(""), "'points' is empty: there is no line 1.");
  EXPECT_EQ(TableErrorOf("\n \n"), "'points' is empty: there is no line 1.");
  EXPECT_EQ(TableErrorOf("1,2,3\n1,2\n"), "'points' has no 3 numbers in line 2.");
  EXPECT_EQ(TableErrorOf("1,2,3\n\n1,2,3,4\n"), "'points' has no 3 numbers in line 3.");
  EXPECT_EQ(TableErrorOf("1,2,3\n1,2,nan\n"), "'points' has no 3 numbers in line 2.");
  EXPECT_EQ(TableErrorOf("1,2,3\n1,2,x\n"), "'points' has no 3 numbers in line 2.");
  EXPECT_EQ(TableErrorOf(std::string(100000, '1')),
    "'points' is not a table of numbers: one of its lines is too long.");
}

TEST(NumberTable, MayBeStoppedBeforeEachLine)
{
  std::istringstream file("1\n2\n3\n4\n");
  int lines = 0;
  EXPECT_THROW((void)ReadNumberTable(file, "points", 1,
                 [&]
                 {
                   if (++lines == 3)
                   {
                     throw Aborted();
                   }
                 }),
    Aborted);
  EXPECT_EQ(lines, 3);
}
