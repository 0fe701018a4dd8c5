// SPDX-License-Identifier: BSD-3-Clause
#include "WatchedFor.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

using namespace freespace;

namespace
{

void TwoThreads(
  std::size_t count, const std::function<void(std::size_t begin, std::size_t end)>& body)
{
  std::thread other([&] { body(0, count / 2); });
  body(count / 2, count);
  other.join();
}

}

TEST(WatchedFor, DoesAllOnce)
{
  for (const std::size_t count : { 0, 1, 7 })
  {
    std::vector<int> calls(count, 0);
    WatchedFor(count, TwoThreads, {}, [&](std::size_t i, const StopFlag&) { ++calls[i]; });
    EXPECT_EQ(calls, std::vector<int>(count, 1));
  }
}

TEST(WatchedFor, ShowsProgressFromTheCallersThreadAndStopsLongBodies)
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
  EXPECT_THROW(WatchedFor(2, TwoThreads, stopAtThird,
                 [](std::size_t, const StopFlag& stop)
                 {
                   while (true)
                   {
                     ThrowIfStopped(stop);
                     std::this_thread::yield();
                   }
                 }),
    Aborted);
  EXPECT_EQ(looks, 3);
}

TEST(WatchedFor, TellsTheFaultThatCameFirst)
{
  try
  {
    WatchedFor(5, SerialFor, {},
      [](std::size_t i, const StopFlag&)
      {
        if (i >= 3)
        {
          throw Error("fault " + std::to_string(i));
        }
      });
    FAIL() << "no fault was told";
  }
  catch (const Error& error)
  {
    EXPECT_STREQ(error.what(), "fault 3");
  }
}
