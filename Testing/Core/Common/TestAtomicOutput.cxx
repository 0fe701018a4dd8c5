// SPDX-License-Identifier: BSD-3-Clause
#include "Common/AtomicOutput.h"

#include "Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

using namespace freespace;
namespace fs = std::filesystem;

namespace
{

std::string Content(const std::string& file)
{
  std::ifstream stream(file, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>() };
}

// The number of entries of a folder, hidden ones too.
std::ptrdiff_t CountEntries(const std::string& folder)
{
  return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

std::string FaultOfCommit(AtomicOutput& output)
{
  try
  {
    output.Commit();
    return "";
  }
  catch (const Error& error)
  {
    return error.what();
  }
}

}

TEST(AtomicOutput, CommitReplacesTheTarget)
{
  const TemporaryFolder folder;
  const std::string target = folder.Write("mesh.ply", "old");
  {
    AtomicOutput output(target);
    output.Write("new one", 7);
    EXPECT_EQ(Content(target), "old") << "before the commit";
    output.Commit();
    EXPECT_EQ(Content(target), "new one");
  }
  EXPECT_EQ(Content(target), "new one");
  EXPECT_EQ(CountEntries(folder.Path()), 1) << "nothing is left beside the target";
}

TEST(AtomicOutput, WithoutCommitTheTargetStays)
{
  const TemporaryFolder folder;
  const std::string target = folder.Write("mesh.ply", "old");
  {
    AtomicOutput output(target);
    output.Write("new", 3);
  }
  EXPECT_EQ(Content(target), "old");
  EXPECT_EQ(CountEntries(folder.Path()), 1);
}

TEST(AtomicOutput, FilesBesideTheTargetMoveWithIt)
{
  const TemporaryFolder folder;
  {
    AtomicOutput output(folder.Path("mesh.obj"));
    output.Write("mesh", 4);
    std::ofstream(fs::path(output.Path()).parent_path() / "mesh.mtl") << "material";
    output.Commit();
  }
  EXPECT_EQ(Content(folder.Path("mesh.obj")), "mesh");
  EXPECT_EQ(Content(folder.Path("mesh.mtl")), "material");
  EXPECT_EQ(CountEntries(folder.Path()), 2);
}

TEST(AtomicOutput, AFolderBesideTheTargetKeepsWhatIsNotAPart)
{
  const TemporaryFolder folder;
  for (const char* name : { "maps_0.vtp", "maps_7.vtp", "maps_x.vtp", "maps_.vtp", "notes.txt" })
  {
    folder.Write(std::string("maps/") + name, "old");
  }
  {
    AtomicOutput output(folder.Path("maps.vtm"));
    output.Write("index", 5);
    const fs::path parts = fs::path(output.Path()).parent_path() / "maps";
    fs::create_directory(parts);
    std::ofstream(parts / "maps_0.vtp") << "new";
    output.Commit();
  }
  EXPECT_EQ(Content(folder.Path("maps/maps_0.vtp")), "new");
  EXPECT_FALSE(fs::exists(folder.Path("maps/maps_7.vtp"))) << "a part of the former target";
  for (const char* name : { "maps_x.vtp", "maps_.vtp", "notes.txt" })
  {
    EXPECT_EQ(Content(folder.Path("maps/") + name), "old") << name;
  }
  EXPECT_EQ(CountEntries(folder.Path()), 2);
}

TEST(AtomicOutput, NothingWrittenIsAnError)
{
  const TemporaryFolder folder;
  AtomicOutput output(folder.Path("mesh.ply"));
  const std::string fault = FaultOfCommit(output);
  EXPECT_NE(fault.find("mesh.ply: nothing was written"), std::string::npos) << fault;
}

TEST(AtomicOutput, AMissingFolderIsAnErrorThatNamesIt)
{
  const TemporaryFolder folder;
  try
  {
    AtomicOutput output(folder.Path("absent/mesh.ply"));
    FAIL() << "no error";
  }
  catch (const Error& error)
  {
    const std::string fault = error.what();
    EXPECT_NE(fault.find("absent/mesh.ply: there is no folder"), std::string::npos) << fault;
  }
  EXPECT_THROW(AtomicOutput(folder.Path() + "/"), Error) << "a target without a name";
  EXPECT_EQ(CountEntries(folder.Path()), 0);
}

TEST(AtomicOutput, AFolderInPlaceOfTheTargetIsAnError)
{
  const TemporaryFolder folder;
  folder.Write("mesh.ply/inside", "old");
  {
    AtomicOutput output(folder.Path("mesh.ply"));
    output.Write("new", 3);
    const std::string fault = FaultOfCommit(output);
    EXPECT_NE(fault.find("mesh.ply: "), std::string::npos) << fault;
  }
  EXPECT_EQ(Content(folder.Path("mesh.ply/inside")), "old");
  EXPECT_EQ(CountEntries(folder.Path()), 1);
}
