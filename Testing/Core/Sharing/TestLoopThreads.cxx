// SPDX-License-Identifier: BSD-3-Clause
#include "Sharing/LoopThreads.h"

#include "Common/Error.h"
#include "Support/Core/TwoThreads.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <random>
#include <string>
#include <thread>

using namespace freespace;

namespace
{

SharedLoop LoopOfItems(std::size_t count)
{
  SharedLoop loop;
  loop.work.assign(count, 1.0);
  loop.make = [](std::size_t item, const CancellationFlag&)
  { return "bytes of " + std::to_string(item); };
  return loop;
}

// Waits until so many have been made.
std::vector<MadeItem> TakeSoMany(LoopThreads& threads, std::size_t count)
{
  std::vector<MadeItem> all;
  while (all.size() < count)
  {
    for (MadeItem& made : threads.TakeMade())
    {
      all.push_back(std::move(made));
    }
    std::this_thread::yield();
  }
  return all;
}

void WaitUntilIdle(LoopThreads& threads, int count)
{
  while (threads.Waiting() != count)
  {
    std::this_thread::yield();
  }
}

}

TEST(LoopThreads, OneThreadMakesTheItemsInTheOrderInWhichTheyAreGiven)
{
  const SharedLoop loop = LoopOfItems(6);
  LoopThreads threads(loop, SerialFor);
  EXPECT_TRUE(threads.TakeMade().empty());
  threads.Give({ 3, 1 });
  threads.Give({});
  threads.Give({ 5 });
  const std::vector<MadeItem> made = TakeSoMany(threads, 3);
  ASSERT_EQ(made.size(), 3u);
  const std::size_t expected[] = { 3, 1, 5 };
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(made[i].item, expected[i]);
    EXPECT_FALSE(made[i].hasFailed);
    EXPECT_EQ(made[i].bytes, "bytes of " + std::to_string(expected[i]));
  }
  EXPECT_TRUE(threads.TakeMade().empty()) << "each is taken once";
}

// What is given and not begun counts against the threads that wait.
TEST(LoopThreads, WaitingAreThreadsWithoutAnItem)
{
  std::atomic<int> begun{ 0 };
  std::atomic<bool> mayEnd{ false };
  SharedLoop loop = LoopOfItems(20); // a thread ends after half of them
  loop.make = [&](std::size_t, const CancellationFlag&)
  {
    ++begun;
    while (!mayEnd)
    {
      std::this_thread::yield();
    }
    return std::string();
  };
  LoopThreads threads(loop, TwoThreads);
  WaitUntilIdle(threads, 2);
  threads.Give({ 0 });
  EXPECT_EQ(threads.Waiting(), 1);
  threads.Give({ 1, 2, 3, 4 });
  while (begun < 2)
  {
    std::this_thread::yield();
  }
  EXPECT_EQ(threads.Waiting(), -3);
  mayEnd = true;
  EXPECT_EQ(TakeSoMany(threads, 5).size(), 5u);
  WaitUntilIdle(threads, 2);
}

TEST(LoopThreads, AnExceptionIsTheItemsFailureAndNoOther)
{
  SharedLoop loop = LoopOfItems(3);
  loop.make = [](std::size_t item, const CancellationFlag&) -> std::string
  {
    if (item == 1)
    {
      throw Error("Item 1 has no image.");
    }
    return "well";
  };
  LoopThreads threads(loop, SerialFor);
  threads.Give({ 0, 1, 2 });
  const std::vector<MadeItem> made = TakeSoMany(threads, 3);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(made[i].hasFailed, i == 1);
    EXPECT_EQ(made[i].bytes, i == 1 ? "Item 1 has no image." : "well");
  }
}

TEST(LoopThreads, TheEndStopsWhatIsBeingMadeAndLeavesTheRest)
{
  std::atomic<int> begun{ 0 }, stopped{ 0 };
  SharedLoop loop = LoopOfItems(9);
  loop.make = [&](std::size_t, const CancellationFlag& stop)
  {
    ++begun;
    while (!stop)
    {
      std::this_thread::yield();
    }
    ++stopped;
    return std::string();
  };
  {
    LoopThreads threads(loop, TwoThreads);
    threads.Give({ 0, 1, 2, 3, 4 });
    while (begun < 2)
    {
      std::this_thread::yield();
    }
  }
  EXPECT_EQ(begun, 2);
  EXPECT_EQ(stopped, 2) << "nobody works on after the end";
}

TEST(LoopThreads, NoItemsNoThreadsWait)
{
  const SharedLoop loop = LoopOfItems(0);
  LoopThreads threads(loop, TwoThreads);
  EXPECT_EQ(threads.Waiting(), 0);
  EXPECT_TRUE(threads.TakeMade().empty());
}

TEST(LoopThreads, TheEndComesBeforeAnyItem)
{
  for (int trial = 0; trial < 200; ++trial)
  {
    const SharedLoop loop = LoopOfItems(trial % 5);
    LoopThreads(loop, TwoThreads);
  }
}

// Whenever items are given and taken: each that was given is made once, as the loop makes it.
TEST(LoopThreads, EachItemGivenIsMadeOnce)
{
  std::mt19937 random(7);
  for (int trial = 0; trial < 40; ++trial)
  {
    const std::size_t count = random() % 40, given = count - random() % (count + 1);
    const unsigned int failing = 1 + random() % 5;
    SharedLoop loop = LoopOfItems(count);
    loop.make = [failing](std::size_t item, const CancellationFlag&)
    {
      if (item % failing == 1)
      {
        throw Error("fault of " + std::to_string(item));
      }
      return "bytes of " + std::to_string(item);
    };
    std::vector<std::size_t> items(count);
    std::iota(items.begin(), items.end(), 0);
    std::shuffle(items.begin(), items.end(), random);
    items.resize(given);
    std::vector<MadeItem> all;
    LoopThreads threads(loop, trial % 2 ? ParallelFor(TwoThreads) : ParallelFor(SerialFor));
    for (std::size_t begin = 0; begin < given;)
    {
      const std::size_t end = std::min<std::size_t>(given, begin + 1 + random() % 7);
      threads.Give({ items.begin() + begin, items.begin() + end });
      begin = end;
      for (MadeItem& made : threads.TakeMade())
      {
        all.push_back(std::move(made));
      }
    }
    for (MadeItem& made : TakeSoMany(threads, given - all.size()))
    {
      all.push_back(std::move(made));
    }
    ASSERT_EQ(all.size(), given);
    std::sort(
      all.begin(), all.end(), [](const MadeItem& a, const MadeItem& b) { return a.item < b.item; });
    std::sort(items.begin(), items.end());
    for (std::size_t i = 0; i < given; ++i)
    {
      EXPECT_EQ(all[i].item, items[i]);
      EXPECT_EQ(all[i].hasFailed, items[i] % failing == 1);
      EXPECT_EQ(
        all[i].bytes, (all[i].hasFailed ? "fault of " : "bytes of ") + std::to_string(items[i]));
    }
  }
}
