// SPDX-License-Identifier: BSD-3-Clause
#include "Common/ParallelForWithProgress.h"

#include "Common/ForEach.h"

#include <algorithm>
#include <chrono>
#include <future>
#include <numeric>

namespace freespace
{

namespace
{

// Indices by descending value; equal values in their order.
std::vector<std::size_t> GreatestFirst(const std::vector<double>& values)
{
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return values[a] > values[b]; });
  return order;
}

void Add(std::atomic<double>& sum, double value)
{
  double before = sum;
  while (!sum.compare_exchange_weak(before, before + value))
  {
  }
}

// Runs the work on another thread while this one polls the progress.
void WatchedWork(const Progress& progress, CancellationFlag& stop,
  const std::function<double()>& fraction, const std::function<void()>& work)
{
  progress(0.0);
  std::future<void> worker = std::async(std::launch::async, work);
  try
  {
    while (worker.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready)
    {
      progress(std::min(fraction(), 1.0));
    }
    worker.get();
  }
  catch (...)
  {
    stop = true;
    if (worker.valid())
    {
      worker.wait();
    }
    throw;
  }
  progress(1.0);
}

}

void ParallelForWithProgress(std::size_t count, const ParallelFor& parallelFor,
  const Progress& progress, const CancellableBody& body)
{
  CancellationFlag stop{ false };
  std::atomic<std::size_t> done{ 0 };
  WatchedWork(
    progress, stop, [&] { return static_cast<double>(done) / std::max<std::size_t>(count, 1); },
    [&]
    {
      ForEach(parallelFor, count,
        [&](std::size_t i)
        {
          ThrowIfCancelled(stop);
          body(i, stop);
          ++done;
        });
    });
}

void ParallelForWithProgress(const std::vector<double>& work, const ParallelFor& parallelFor,
  const Progress& progress, const CancellableBody& body)
{
  const std::vector<std::size_t> order = GreatestFirst(work);
  const double all = std::max(std::accumulate(work.begin(), work.end(), 0.0), 1e-300);
  FirstFault fault(work.size());
  CancellationFlag stop{ false };
  std::atomic<double> done{ 0.0 };
  std::atomic<std::size_t> next{ 0 };
  const auto doNext = [&]
  {
    const std::size_t index = order[next++];
    if (!fault.IsBefore(index))
    {
      fault.Guard(index,
        [&](std::size_t i)
        {
          ThrowIfCancelled(stop);
          body(i, stop);
        });
    }
    Add(done, work[index]);
  };
  WatchedWork(
    progress, stop, [&] { return done / all; },
    [&]
    {
      // The order of a parallel loop is unspecified: each of its indices takes the next item.
      parallelFor(work.size(),
        [&](std::size_t begin, std::size_t end)
        {
          for (; begin < end; ++begin)
          {
            doNext();
          }
        });
      fault.Rethrow();
    });
}

void RunWithProgress(
  const Progress& progress, const std::function<void(const CancellationFlag& stop)>& body)
{
  CancellationFlag stop{ false };
  WatchedWork(
    progress, stop, [] { return 0.0; }, [&] { body(stop); });
}

}
