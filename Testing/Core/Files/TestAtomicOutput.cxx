// SPDX-License-Identifier: BSD-3-Clause
#include "Files/AtomicOutput.h"

#include "Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
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
  EXPECT_THROW(AtomicOutput(folder.Path("mesh.ply")), Error);
  EXPECT_EQ(Content(folder.Path("mesh.ply/inside")), "old");
  EXPECT_EQ(CountEntries(folder.Path()), 1);
}

TEST(AtomicOutput, ASymbolicLinkIsWrittenThrough)
{
  const TemporaryFolder folder;
  folder.Write("real/old.ply", "old");
  fs::create_symlink("real/old.ply", folder.Path("link.ply"));
  fs::create_symlink("real/none.ply", folder.Path("dangling.ply"));
  for (const char* name : { "link.ply", "dangling.ply" })
  {
    AtomicOutput output(folder.Path(name));
    output.Write("new", 3);
    output.Commit();
    EXPECT_TRUE(fs::is_symlink(folder.Path(name)));
    EXPECT_EQ(Content(folder.Path(name)), "new");
  }
  EXPECT_EQ(Content(folder.Path("real/old.ply")), "new");
  fs::create_symlink("circle.ply", folder.Path("circle.ply"));
  EXPECT_THROW(AtomicOutput(folder.Path("circle.ply")), Error);
}

TEST(AtomicOutput, ModeStays)
{
  const TemporaryFolder folder;
  const std::string target = folder.Write("mesh.ply", "old");
  fs::permissions(target, fs::perms(0640));
  AtomicOutput output(target);
  output.Write("new", 3);
  output.Commit();
  EXPECT_EQ(fs::status(target).permissions(), fs::perms(0640));
}

TEST(AtomicOutput, APipeGetsTheBytes)
{
  const TemporaryFolder folder;
  const std::string pipe = folder.Path("mesh.ply");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::string got;
  std::thread reader([&] { got = Content(pipe); });
  {
    AtomicOutput output(pipe);
    output.Write("bytes", 5);
    output.Commit();
  }
  reader.join();
  EXPECT_EQ(got, "bytes");
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(CountEntries(folder.Path()), 1);
}

TEST(AtomicOutput, DevicesAreNotReplaced)
{
  AtomicOutput output("/dev/null");
  output.Write("bytes", 5);
  output.Commit();
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(AtomicOutput, TemporaryFoldersOfTheDeadAreRemoved)
{
  const TemporaryFolder folder;
  const pid_t child = fork();
  if (child == 0)
  {
    AtomicOutput output(folder.Path("mesh.ply"));
    output.Write("half", 4);
    _exit(0);
  }
  waitpid(child, nullptr, 0);
  ASSERT_EQ(CountEntries(folder.Path()), 1) << "what the child left";
  folder.Write(".freespace-settings/mine", "kept");
  {
    const AtomicOutput output(folder.Path("mesh.ply"));
    EXPECT_EQ(CountEntries(folder.Path()), 2);
  }
  EXPECT_EQ(CountEntries(folder.Path()), 1);
}

// A commit whose last step fails: the target became a folder meanwhile.
TEST(AtomicOutput, AFailedCommitLeavesAllAsItWas)
{
  const TemporaryFolder folder;
  folder.Write("maps/maps_0.vtp", "old");
  folder.Write("maps.mtl", "old");
  {
    AtomicOutput output(folder.Path("maps.vtm"));
    output.Write("index", 5);
    const fs::path beside = fs::path(output.Path()).parent_path();
    fs::create_directory(beside / "maps");
    std::ofstream(beside / "maps/maps_0.vtp") << "new";
    std::ofstream(beside / "maps/maps_1.vtp") << "new";
    std::ofstream(beside / "maps.mtl") << "new";
    folder.Write("maps.vtm/inside", "in the way");
    EXPECT_NE(FaultOfCommit(output), "");
  }
  EXPECT_EQ(Content(folder.Path("maps/maps_0.vtp")), "old");
  EXPECT_FALSE(fs::exists(folder.Path("maps/maps_1.vtp")));
  EXPECT_EQ(Content(folder.Path("maps.mtl")), "old");
  EXPECT_EQ(CountEntries(folder.Path()), 3);
}

TEST(AtomicOutput, FirstFreePart)
{
  const TemporaryFolder folder;
  AtomicOutput output(folder.Path("maps.vtm"));
  EXPECT_EQ(output.FirstFreePart(3), 0);
  folder.Write("maps/maps_0.vtp", "");
  folder.Write("maps/maps_1.vtp", "");
  EXPECT_EQ(output.FirstFreePart(3), 2);
  fs::remove(folder.Path("maps/maps_0.vtp"));
  EXPECT_EQ(output.FirstFreePart(1), 0);
}

// One process may have several outputs in a folder, and outputs in a work folder, which it holds itself.
TEST(AtomicOutput, OutputsOfOneProcessDoNotWaitForEachOther)
{
  const TemporaryFolder folder;
  AtomicOutput first(folder.Path("first"));
  first.Write("1", 1);
  first.Commit();
  AtomicOutput second(folder.Path("second"));
  second.Write("2", 1);
  second.Commit();
  const WorkFolder work(folder.Path(""));
  const std::string inWork = (work.Path() / "third").string();
  AtomicOutput third(inWork);
  third.Write("3", 1);
  third.Commit();
  EXPECT_EQ(
    Content(folder.Path("first")) + Content(folder.Path("second")) + Content(inWork), "123");
}
