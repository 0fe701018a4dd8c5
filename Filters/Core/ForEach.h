// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ForEach_h
#define freespace_ForEach_h

#include "ParallelFor.h"

#include <atomic>
#include <exception>
#include <vector>

namespace freespace
{

/// Calls body(i) for each i in [0, count), perhaps on several threads. Where bodies throw, what the one
/// of the least i threw is thrown on, the same for any number of threads; what comes after it may not be
/// called.
template <typename Body>
void ForEach(const ParallelFor& parallelFor, std::size_t count, const Body& body)
{
  std::vector<std::exception_ptr> faults(count);
  std::atomic<std::size_t> first{ count };
  parallelFor(count,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end && i < first; ++i)
      {
        try
        {
          body(i);
        }
        catch (...)
        {
          faults[i] = std::current_exception();
          std::size_t before = first;
          while (i < before && !first.compare_exchange_weak(before, i))
          {
          }
        }
      }
    });
  if (first < count)
  {
    std::rethrow_exception(faults[first]);
  }
}

}

#endif
