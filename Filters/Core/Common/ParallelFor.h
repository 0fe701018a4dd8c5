// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ParallelFor_h
#define freespace_ParallelFor_h

#include <cstddef>
#include <functional>

namespace freespace
{

/// Calls the body over ranges [begin, end) that together make [0, count), perhaps on several threads.
/// The core does not know its threads: the VTK classes hand in vtkSMPTools (see SMPParallelFor.h).
/// The body must not throw, and must write only what belongs to its own range, so that the result is
/// the same for any number of threads.
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
