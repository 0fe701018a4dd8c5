// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ParallelFor_h
#define freespace_ParallelFor_h

#include <cstddef>
#include <functional>
#include <type_traits>
#include <utility>

namespace freespace
{

class SharedWork;

/// Calls the body for ranges [begin, end) that partition [0, count), possibly on several threads.
/// The core does not create threads: the VTK classes pass vtkSMPTools (see SMPParallelFor.h).
/// The body must not throw, and must write only data of its own range, so that the result does not
/// depend on the number of threads.
///
/// Where several processes do the same computation, it also knows what shares the work out among them, for those
/// loops whose values are worth to be sent (MakeAll); all other loops are done in each process.
class ParallelFor
{
public:
  using Body = std::function<void(std::size_t begin, std::size_t end)>;

  template <typename Function,
    typename = std::enable_if_t<!std::is_same_v<std::decay_t<Function>, ParallelFor>>>
  ParallelFor(Function&& threads, SharedWork* processes = nullptr)
    : Threads(std::forward<Function>(threads))
    , Processes(processes)
  {
  }

  void operator()(std::size_t count, const Body& body) const { this->Threads(count, body); }

  /// Null where this process is alone.
  SharedWork* Shared() const { return this->Processes; }

private:
  std::function<void(std::size_t count, const Body& body)> Threads;
  SharedWork* Processes;
};

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
