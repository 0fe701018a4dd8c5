// SPDX-License-Identifier: BSD-3-Clause
#include "Files/FileLock.h"

#include "Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <future>

using namespace freespace;

TEST(FileLock, KeepsOthersOutUntilItEnds)
{
  const TemporaryFolder folder;
  {
    const FileLock first = FileLock::Try(folder.Path());
    EXPECT_TRUE(first.IsHeld());
    EXPECT_FALSE(FileLock::Try(folder.Path()).IsHeld());
  }
  EXPECT_TRUE(FileLock::Try(folder.Path()).IsHeld());
}

TEST(FileLock, MovesToAnother)
{
  const TemporaryFolder folder;
  FileLock first = FileLock::Try(folder.Path());
  FileLock second;
  second = std::move(first);
  EXPECT_FALSE(first.IsHeld()); // NOLINT(bugprone-use-after-move): it is told to hold nothing then
  EXPECT_TRUE(second.IsHeld());
  EXPECT_FALSE(FileLock::Try(folder.Path()).IsHeld());
  second = FileLock();
  EXPECT_TRUE(FileLock::Try(folder.Path()).IsHeld());
}

TEST(FileLock, WaitsForAnother)
{
  const TemporaryFolder folder;
  FileLock first = FileLock::Try(folder.Path());
  auto second = std::async(std::launch::async, [&] { return FileLock::Wait(folder.Path()); });
  EXPECT_EQ(second.wait_for(std::chrono::milliseconds(50)), std::future_status::timeout);
  first = FileLock();
  EXPECT_TRUE(second.get().IsHeld());
}

TEST(FileLock, HoldsNothingThatIsMissing)
{
  const TemporaryFolder folder;
  EXPECT_FALSE(FileLock().IsHeld());
  EXPECT_FALSE(FileLock::Try(folder.Path() + "/missing").IsHeld());
  EXPECT_FALSE(FileLock::Wait(folder.Path() + "/missing").IsHeld());
}
