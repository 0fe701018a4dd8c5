// SPDX-License-Identifier: BSD-3-Clause
#include "Files/FileNames.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace freespace;
using Names = std::vector<std::string>;

TEST(FileNames, OrdinaryNamesStay)
{
  for (const char* name : { "cluster1", "a b", "IMG_0001.JPG", "caf\xe9", "\xc3\xa9", "a..b" })
  {
    EXPECT_EQ(FileNameOf(name), name);
  }
}

TEST(FileNames, NoNameLeavesItsFolder)
{
  const std::string folder = "/folder";
  for (const std::string& name : { std::string("../../x"), std::string("/x"), std::string(".."),
         std::string("."), std::string(), std::string("a/../../b"), std::string("..\\x"),
         std::string(".hidden"), std::string("a\nb\x1b[31m"), std::string(5000, 'x') })
  {
    const std::string file = FileNameOf(name);
    const auto path = (std::filesystem::path(folder) / (file + ".png")).lexically_normal();
    EXPECT_EQ(path.parent_path(), folder) << name;
    EXPECT_NE(file[0], '.') << name;
    EXPECT_LE(file.size(), 201u) << name;
    EXPECT_EQ(file.find_first_of("\n\x1b"), std::string::npos) << name;
  }
}

TEST(FileNames, NamesThatBecomeTheSameAreNumbered)
{
  EXPECT_EQ(FileNamesOf({ "a/b", "a_b", "c", "a_b-2" }), (Names{ "a_b", "a_b-2", "c", "a_b-2-2" }));
}

TEST(FileNames, OfImagesInOneFolder)
{
  EXPECT_EQ(DistinctFileNames({ "a/1.png", "a/2.png" }), (Names{ "1", "2" }));
  EXPECT_EQ(DistinctFileNames({}), Names{});
}

TEST(FileNames, OfImagesInSeveralFolders)
{
  EXPECT_EQ(DistinctFileNames({ "s/a/1.png", "s/b/1.png", "s/b/c/2.png" }),
    (Names{ "a_1", "b_1", "b_c_2" }));
  EXPECT_EQ(DistinctFileNames({ "s/1.png", "s/1.jpg" }), (Names{ "1", "1-2" }));
  EXPECT_EQ(DistinctFileNames({ "s/1.png", "s/1.png" }), (Names{ "1", "1-2" }));
}
