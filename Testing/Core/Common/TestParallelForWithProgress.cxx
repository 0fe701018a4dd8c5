// SPDX-License-Identifier: BSD-3-Clause
#include "Common/ParallelForWithProgress.h"

#include "Support/Core/TwoThreads.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

using namespace freespace;

TEST(ParallelForWithProgress, DoesAllOnce)
{
  for (const std::size_t count : { 0, 1, 7 })
  {
    std::vector<int> calls(count, 0);
    ParallelForWithProgress(
      count, TwoThreads, {}, [&](std::size_t i, const CancellationFlag&) { ++calls[i]; });
    EXPECT_EQ(calls, std::vector<int>(count, 1));
  }
}

TEST(ParallelForWithProgress, BeginsWithTheMostWork)
{
  const std::vector<double> work = { 1, 5, 0, 5, 2 };
  std::vector<std::size_t> order;
  ParallelForWithProgress(
    work, SerialFor, {}, [&](std::size_t i, const CancellationFlag&) { order.push_back(i); });
  EXPECT_EQ(order, (std::vector<std::size_t>{ 1, 3, 4, 0, 2 }));
  std::vector<int> calls(work.size(), 0);
  ParallelForWithProgress(
    work, TwoThreads, {}, [&](std::size_t i, const CancellationFlag&) { ++calls[i]; });
  EXPECT_EQ(calls, std::vector<int>(work.size(), 1));
  ParallelForWithProgress(
    std::vector<double>(), TwoThreads, {}, [](std::size_t, const CancellationFlag&) { FAIL(); });
}

TEST(ParallelForWithProgress, ShowsProgressFromTheCallersThreadAndStopsLongBodies)
{
  const std::thread::id caller = std::this_thread::get_id();
  int looks = 0;
  double last = 0.0;
  const Progress stopAtThird(
    [&](double fraction)
    {
      EXPECT_EQ(std::this_thread::get_id(), caller);
      EXPECT_GE(fraction, last);
      last = fraction;
      return ++looks < 3;
    });
  // Bodies that would never end by themselves.
  EXPECT_THROW(ParallelForWithProgress(2, TwoThreads, stopAtThird,
                 [](std::size_t, const CancellationFlag& stop)
                 {
                   while (true)
                   {
                     ThrowIfCancelled(stop);
                     std::this_thread::yield();
                   }
                 }),
    Aborted);
  EXPECT_EQ(looks, 3);
}

TEST(ParallelForWithProgress, TellsTheFaultThatCameFirst)
{
  const auto fault = [](std::size_t i, const CancellationFlag&)
  {
    if (i >= 3)
    {
      throw Error("fault " + std::to_string(i));
    }
  };
  const std::vector<double> work = { 1, 2, 3, 4, 5 };
  for (const bool isWeighed : { false, true })
  {
    for (const ParallelFor& parallelFor : { ParallelFor(SerialFor), ParallelFor(TwoThreads) })
    {
      try
      {
        isWeighed ? ParallelForWithProgress(work, parallelFor, {}, fault)
                  : ParallelForWithProgress(5, parallelFor, {}, fault);
        FAIL() << "no fault was told";
      }
      catch (const Error& error)
      {
        EXPECT_STREQ(error.what(), "fault 3");
      }
    }
  }
}

TEST(ParallelForWithProgress, ProgressMovesWithTheWork)
{
  std::atomic<bool> isFirstDone{ false };
  double most = 0.0;
  const Progress progress(
    [&](double fraction)
    {
      most = std::max(most, fraction);
      return !(isFirstDone && fraction >= 0.9);
    });
  // The last waits until it is told to stop: nine tenths of the work are done then.
  EXPECT_THROW(ParallelForWithProgress(std::vector<double>{ 1, 9 }, SerialFor, progress,
                 [&](std::size_t i, const CancellationFlag& stop)
                 {
                   isFirstDone = true;
                   while (i == 0 && !stop)
                   {
                     std::this_thread::yield();
                   }
                   ThrowIfCancelled(stop);
                 }),
    Aborted);
  EXPECT_DOUBLE_EQ(most, 0.9);
}

TEST(RunWithProgress, DoesItAndStopsIt)
{
  bool isDone = false;
  RunWithProgress({}, [&](const CancellationFlag&) { isDone = true; });
  EXPECT_TRUE(isDone);
  int looks = 0;
  EXPECT_THROW(RunWithProgress(Progress([&](double) { return ++looks < 2; }),
                 [](const CancellationFlag& stop)
                 {
                   while (true)
                   {
                     ThrowIfCancelled(stop);
                     std::this_thread::yield();
                   }
                 }),
    Aborted);
}
