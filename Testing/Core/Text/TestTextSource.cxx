// SPDX-License-Identifier: BSD-3-Clause
#include "Text/TextSource.h"

#include "Common/Error.h"
#include "Support/TemporaryFolder.h"
#include "Support/Core/ErrorOf.h"

#include <gtest/gtest.h>

#include <functional>

using namespace freespace;

TEST(TextSource, FieldsOfALine)
{
  const TemporaryFolder folder;
  TextSource text(folder.Write("a.txt", "  7 -2.5\t+3e1 name  with blanks \r\n8"));
  EXPECT_TRUE(text.AtLineEnd()) << "before the first line";
  ASSERT_TRUE(text.NextLine());
  EXPECT_EQ(text.Number<int>("a number"), 7);
  EXPECT_EQ(text.Number<double>("a number"), -2.5);
  EXPECT_EQ(text.Number<double>("a number"), 30.0);
  EXPECT_EQ(text.Field("a name"), "name");
  EXPECT_FALSE(text.AtLineEnd());
  EXPECT_EQ(text.Remainder("the rest"), "with blanks");
  EXPECT_TRUE(text.AtLineEnd());
  ASSERT_TRUE(text.NextLine());
  EXPECT_EQ(text.Number<int>("a number"), 8);
  EXPECT_FALSE(text.NextLine());
}

TEST(TextSource, EntriesAreNeitherEmptyNorComments)
{
  const TemporaryFolder folder;
  TextSource text(folder.Write("a.txt", "# comment\n\n \t\n1\n#2\n3\n"));
  ASSERT_TRUE(text.NextEntry());
  EXPECT_EQ(text.Number<int>("a number"), 1);
  ASSERT_TRUE(text.NextEntry());
  EXPECT_EQ(text.Number<int>("a number"), 3);
  EXPECT_FALSE(text.NextEntry());
}

TEST(TextSource, LineEndsMayBeBlanks)
{
  const TemporaryFolder folder;
  const std::string file = folder.Write("a.txt", "1\n# comment\n\n2 3");
  TextSource blank(file, TextSource::Lines::Blank);
  for (int value = 1; value <= 3; ++value)
  {
    EXPECT_EQ(blank.Number<int>("a number"), value);
  }
  EXPECT_THROW(blank.Number<int>("a number"), Error);
  TextSource separate(file);
  separate.NextLine();
  EXPECT_EQ(separate.Number<int>("a number"), 1);
  EXPECT_THROW(separate.Number<int>("a number"), Error);
}

TEST(TextSource, FaultsNameFileLineAndField)
{
  const TemporaryFolder folder;
  const std::string file = folder.Write("a.txt", "1\n2 x\n");
  TextSource text(file);
  text.NextLine();
  text.NextLine();
  text.Number<int>("a number");
  EXPECT_EQ(ErrorOf([&] { text.Number<int>("a width"); }),
    "Cannot read " + file + ", line 2: 'x' is not a width.");
  EXPECT_EQ(ErrorOf([&] { text.Field("a name"); }),
    "Cannot read " + file + ", line 2: it ends before a name.");
  EXPECT_EQ(ErrorOf([&] { text.Fail("wrong"); }), "Cannot read " + file + ", line 2: wrong.");
}

TEST(TextSource, EmptyFile)
{
  const TemporaryFolder folder;
  TextSource text(folder.Write("empty.txt", ""));
  EXPECT_FALSE(text.NextLine());
  EXPECT_FALSE(text.NextEntry());
  EXPECT_THROW(text.Field("a name"), Error);
}

TEST(TextSource, MissingFileAndFolder)
{
  const TemporaryFolder folder;
  const std::string absent = folder.Path("absent.txt");
  EXPECT_NE(ErrorOf([&] { TextSource text(absent); }).find(absent), std::string::npos);
  EXPECT_NE(ErrorOf([&] { ReadWholeFile(folder.Path()); }), "");
  const std::string bytes("a\0b\n", 4);
  EXPECT_EQ(ReadWholeFile(folder.Write("bytes", bytes)), bytes);
}
