// SPDX-License-Identifier: BSD-3-Clause
#include "WatchedFor.h"

#include "ForEach.h"

#include <algorithm>
#include <chrono>
#include <future>

namespace freespace
{

void WatchedFor(std::size_t count, const ParallelFor& parallelFor, const Progress& progress,
  const std::function<void(std::size_t i, const StopFlag& stop)>& body)
{
  progress(0.0);
  StopFlag stop{ false };
  std::atomic<std::size_t> done{ 0 };
  std::future<void> work = std::async(std::launch::async,
    [&]
    {
      ForEach(parallelFor, count,
        [&](std::size_t i)
        {
          ThrowIfStopped(stop);
          body(i, stop);
          ++done;
        });
    });
  try
  {
    while (work.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready)
    {
      progress(static_cast<double>(done) / std::max<std::size_t>(count, 1));
    }
    work.get();
  }
  catch (...)
  {
    stop = true;
    if (work.valid())
    {
      work.wait();
    }
    throw;
  }
  progress(1.0);
}

}
