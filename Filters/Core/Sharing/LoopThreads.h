// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_LoopThreads_h
#define freespace_LoopThreads_h

#include "Common/CancellationFlag.h"
#include "Common/ParallelFor.h"
#include "Sharing/SharedLoop.h"

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <future>
#include <mutex>
#include <optional>
#include <vector>

namespace freespace
{

/// The threads of one process, which work on the items of a loop that it is given, while the thread that has made them
/// exchanges messages.
class LoopThreads
{
public:
  LoopThreads(const SharedLoop& loop, const ParallelFor& parallelFor);

  /// Stops what is being made.
  ~LoopThreads();
  LoopThreads(const LoopThreads&) = delete;
  LoopThreads& operator=(const LoopThreads&) = delete;

  /// How many threads have no item.
  int Waiting();
  void Give(const std::vector<std::size_t>& items);

  /// What was made since this was called last.
  std::vector<MadeItem> TakeMade();

private:
  void Work();
  std::optional<std::size_t> Next();

  const SharedLoop& Loop;
  CancellationFlag Stop{ false };
  std::mutex Mutex; // of what follows
  std::condition_variable Arrived;
  std::deque<std::size_t> Items;
  int Idle = 0;
  std::vector<MadeItem> Made;
  std::future<void> Threads;
};

}

#endif
