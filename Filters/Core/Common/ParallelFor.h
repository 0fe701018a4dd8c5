// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ParallelFor_h
#define freespace_ParallelFor_h

#include <cstddef>
#include <functional>

namespace freespace
{

/// Calls the body for ranges [begin, end) that partition [0, count), possibly on several threads.
/// The core does not create threads: the VTK classes pass vtkSMPTools (see SMPParallelFor.h).
/// The body must not throw, and must write only data of its own range, so that the result does not
/// depend on the number of threads.
using ParallelFor = std::function<void(
  std::size_t count, const std::function<void(std::size_t begin, std::size_t end)>& body)>;

/// On the calling thread.
inline void SerialFor(
  std::size_t count, const std::function<void(std::size_t begin, std::size_t end)>& body)
{
  if (count > 0)
  {
    body(0, count);
  }
}

}

#endif
