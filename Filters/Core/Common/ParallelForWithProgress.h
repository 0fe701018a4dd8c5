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

/// The body of a loop.
using CancellableBody = std::function<void(std::size_t i, const CancellationFlag& stop)>;

/// Calls body(i, stop) for all i below count by the parallel loop, which another thread starts. The
/// calling thread meanwhile reports progress every 20 ms and can stop the work, however long a single
/// body takes. Rethrows the exception of the progress, or else that of the bodies, as ForEach does, after
/// all bodies have ended.
void ParallelForWithProgress(std::size_t count, const ParallelFor& parallelFor,
  const Progress& progress, const CancellableBody& body);

/// The same for bodies of unequal cost, which is known in advance in any unit: the most expensive ones
/// start first, so that none remains for a single thread at the end, and progress is proportional to the
/// cost.
void ParallelForWithProgress(const std::vector<double>& work, const ParallelFor& parallelFor,
  const Progress& progress, const CancellableBody& body);

/// A single computation that can be stopped; it reports no progress.
void RunWithProgress(
  const Progress& progress, const std::function<void(const CancellationFlag& stop)>& body);

}

#endif
