// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_WatchedFor_h
#define freespace_WatchedFor_h

#include "ParallelFor.h"
#include "Progress.h"
#include "StopFlag.h"

#include <functional>
#include <vector>

namespace freespace
{

/// What a loop does for each i.
using WatchedBody = std::function<void(std::size_t i, const StopFlag& stop)>;

/// Calls body(i, stop) for all i below count by the parallel loop, which another thread starts: the
/// caller looks at the progress every 20 ms meanwhile, so that it moves, and can stop the work, however
/// long a single body takes. Throws what the progress threw, or else what the bodies did, like ForEach; all
/// bodies have ended then.
void WatchedFor(std::size_t count, const ParallelFor& parallelFor, const Progress& progress,
  const WatchedBody& body);

/// The same for bodies of unequal size, of which the work, in any unit, is known before: the largest
/// begin first, so that no thread is left alone with one at the end, and the progress moves with the
/// work.
void WatchedFor(const std::vector<double>& work, const ParallelFor& parallelFor,
  const Progress& progress, const WatchedBody& body);

/// A single computation, watched in the same way; its progress does not move.
void Watched(const Progress& progress, const std::function<void(const StopFlag& stop)>& body);

}

#endif
