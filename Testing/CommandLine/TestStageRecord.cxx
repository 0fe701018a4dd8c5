// SPDX-License-Identifier: BSD-3-Clause
#include "Common/Error.h"
#include "Report/Page/StageRecord.h"
#include "Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <fstream>

using namespace freespace;

namespace
{

namespace fs = std::filesystem;

void WriteAt(const std::string& file, int seconds)
{
  std::ofstream(file) << "x";
  fs::last_write_time(file, fs::file_time_type() + std::chrono::seconds(1000000 + seconds));
}

}

TEST(StageRecord, IsCurrentWithTheSameOptionsAndOlderInputs)
{
  const TemporaryFolder folder;
  const std::string file = folder.Path("stages.json");
  const std::string input = folder.Path("in");
  const std::string output = folder.Path("out");
  WriteAt(input, 0);
  WriteAt(output, 10);
  StageRecord(file).Set("maps", { "--cells", "7" }, 1.5);
  const StageRecord record(file);
  EXPECT_TRUE(record.IsCurrent("maps", { "--cells", "7" }, output, { input }));
  EXPECT_EQ(record.Seconds("maps"), 1.5);
  EXPECT_FALSE(record.IsCurrent("maps", { "--cells", "8" }, output, { input }));
  EXPECT_FALSE(record.IsCurrent("maps", {}, output, { input }));
  EXPECT_FALSE(record.IsCurrent("other", { "--cells", "7" }, output, { input }));
  EXPECT_FALSE(record.IsCurrent("maps", { "--cells", "7" }, folder.Path("none"), { input }));
  EXPECT_FALSE(record.IsCurrent("maps", { "--cells", "7" }, output, { folder.Path("none") }));
  WriteAt(input, 11);
  EXPECT_FALSE(record.IsCurrent("maps", { "--cells", "7" }, output, { input }));
}

TEST(StageRecord, KeepsChoices)
{
  const TemporaryFolder folder;
  const std::string file = folder.Path("stages.json");
  const Choices choices = { { "clusters", "3 of 5" }, { "clusters", "none" } };
  StageRecord(file).Set("features", {}, 1, 0, choices);
  StageRecord(file).Set("maps", {}, 1);
  EXPECT_EQ(StageRecord(file).ChoicesOf("features"), choices);
  EXPECT_TRUE(StageRecord(file).ChoicesOf("maps").empty());
  EXPECT_TRUE(StageRecord(file).ChoicesOf("surface").empty());
}

TEST(StageRecord, LooksIntoFolders)
{
  const TemporaryFolder folder;
  fs::create_directories(folder.Path("model/deep"));
  WriteAt(folder.Path("model/deep/cameras.txt"), 5);
  WriteAt(folder.Path("model/images.txt"), 3);
  EXPECT_EQ(
    NewestTime(folder.Path("model")), fs::last_write_time(folder.Path("model/deep/cameras.txt")));
  EXPECT_EQ(NewestTime(folder.Path("none")), fs::file_time_type::min());
}

TEST(StageRecord, KeepsTheOtherStages)
{
  const TemporaryFolder folder;
  const std::string file = folder.Path("stages.json");
  StageRecord(file).Set("a", {}, 1);
  StageRecord(file).Set("b", { "odd \"name\" \xff" }, 2);
  const StageRecord record(file);
  EXPECT_EQ(record.Seconds("a"), 1);
  EXPECT_EQ(record.Seconds("b"), 2);
  EXPECT_EQ(record.Seconds("c"), 0);
}

TEST(StageRecord, IsEmptyWhereTheFileIsNone)
{
  const TemporaryFolder folder;
  WriteAt(folder.Path("out"), 0);
  for (const char* text : { "", "{", "[]", "{\"stages\": 3}", "{\"stages\": {\"a\": {}}}" })
  {
    std::ofstream(folder.Path("stages.json")) << text;
    const StageRecord record(folder.Path("stages.json"));
    EXPECT_FALSE(record.IsCurrent("a", {}, folder.Path("out"), {})) << text;
  }
}

TEST(StageRecord, NamesTheFileThatCannotBeWritten)
{
  try
  {
    StageRecord("/nowhere/stages.json").Set("a", {}, 1);
    FAIL();
  }
  catch (const Error& error)
  {
    EXPECT_NE(std::string(error.what()).find("/nowhere/stages.json"), std::string::npos);
  }
}
