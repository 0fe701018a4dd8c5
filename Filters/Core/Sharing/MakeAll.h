// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_MakeAll_h
#define freespace_MakeAll_h

#include "Common/ParallelForWithProgress.h"
#include "Sharing/Bytes.h"
#include "Sharing/SharedLoop.h"
#include "Sharing/SharedWork.h"

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace freespace
{

/// The value of an item of a loop.
template <typename Value>
using MakeItem = std::function<Value(std::size_t item, const CancellationFlag& stop)>;

/// The values of all items. Where processes share the work out, each makes some and receives the others' (see Bytes.h),
/// so that all have the same. Progress and exceptions as of ParallelForWithProgress.
template <typename Value>
std::vector<Value> MakeAll(SharedLoop loop, const ParallelFor& parallelFor,
  const Progress& progress, const MakeItem<Value>& make)
{
  std::vector<Value> values(loop.work.size());
  if (!parallelFor.Shared())
  {
    ParallelForWithProgress(loop.work, parallelFor, progress,
      [&](std::size_t i, const CancellationFlag& stop) { values[i] = make(i, stop); });
    return values;
  }
  loop.make = [&](std::size_t i, const CancellationFlag& stop)
  {
    values[i] = make(i, stop);
    return BytesOf(values[i]);
  };
  loop.take = [&](std::size_t i, const std::string& bytes) { values[i] = FromBytes<Value>(bytes); };
  parallelFor.Shared()->Do(loop, parallelFor, progress);
  return values;
}

/// Of items of unequal cost: the most expensive ones are begun first.
template <typename Value>
std::vector<Value> MakeAll(const std::vector<double>& work, const ParallelFor& parallelFor,
  const Progress& progress, const MakeItem<Value>& make)
{
  SharedLoop loop;
  loop.work = work;
  return MakeAll(std::move(loop), parallelFor, progress, make);
}

/// Of items of equal cost, of which neighbours need the same images.
template <typename Value>
std::vector<Value> MakeAll(std::size_t count, const ParallelFor& parallelFor,
  const Progress& progress, const MakeItem<Value>& make)
{
  SharedLoop loop;
  loop.work.assign(count, 1.0);
  loop.areNeighborsAlike = true;
  return MakeAll(std::move(loop), parallelFor, progress, make);
}

}

#endif
