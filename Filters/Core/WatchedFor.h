// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_WatchedFor_h
#define freespace_WatchedFor_h

#include "ParallelFor.h"
#include "Progress.h"

#include <atomic>
#include <functional>

namespace freespace
{

/// Set when a computation is to stop. Whoever works long looks at it now and then.
using StopFlag = std::atomic<bool>;

/// Throws Aborted when the flag is set.
inline void ThrowIfStopped(const StopFlag& stop)
{
  if (stop)
  {
    throw Aborted();
  }
}

/// Calls body(i, stop) for all i below count by the parallel loop, which another thread starts: the
/// caller looks at the progress every 20 ms meanwhile, so that it moves, and can stop the work, however
/// long a single body takes. Throws what the progress threw, or else what the bodies did, like ForEach; all
/// bodies have ended then.
void WatchedFor(std::size_t count, const ParallelFor& parallelFor, const Progress& progress,
  const std::function<void(std::size_t i, const StopFlag& stop)>& body);

}

#endif
