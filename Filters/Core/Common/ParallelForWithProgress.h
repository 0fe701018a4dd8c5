// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ParallelForWithProgress_h
#define freespace_ParallelForWithProgress_h

#include "Common/CancellationFlag.h"
#include "Common/ParallelFor.h"
#include "Common/Progress.h"

#include <functional>
#include <vector>

namespace freespace
{

/// What a loop does for each i.
using CancellableBody = std::function<void(std::size_t i, const CancellationFlag& stop)>;

/// Calls body(i, stop) for all i below count by the parallel loop, which another thread starts: the
/// caller looks at the progress every 20 ms meanwhile, so that it moves, and can stop the work, however
/// long a single body takes. Throws what the progress threw, or else what the bodies did, like ForEach; all
/// bodies have ended then.
void ParallelForWithProgress(std::size_t count, const ParallelFor& parallelFor,
  const Progress& progress, const CancellableBody& body);

/// The same for bodies of unequal size, of which the work, in any unit, is known before: the largest
/// begin first, so that no thread is left alone with one at the end, and the progress moves with the
/// work.
void ParallelForWithProgress(const std::vector<double>& work, const ParallelFor& parallelFor,
  const Progress& progress, const CancellableBody& body);

/// A single computation, watched in the same way; its progress does not move.
void RunWithProgress(
  const Progress& progress, const std::function<void(const CancellationFlag& stop)>& body);

}

#endif
