// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ForEach_h
#define freespace_ForEach_h

#include "Common/ParallelFor.h"

#include <atomic>
#include <exception>
#include <vector>

namespace freespace
{

/// Of the exceptions that the bodies of a parallel loop throw, the one of the smallest index, so that
/// it does not depend on the number of threads.
class FirstFault
{
public:
  explicit FirstFault(std::size_t count)
    : Faults(count)
    , First(count)
  {
  }

  /// Whether a smaller index has thrown, so that i need not be processed.
  bool IsBefore(std::size_t i) const { return this->First < i; }

  /// Calls body(i) and stores its exception.
  template <typename Body>
  void Guard(std::size_t i, const Body& body)
  {
    try
    {
      body(i);
    }
    catch (...)
    {
      this->Faults[i] = std::current_exception();
      std::size_t before = this->First;
      while (i < before && !this->First.compare_exchange_weak(before, i))
      {
      }
    }
  }

  /// Rethrows the exception, if any, after the loop.
  void Rethrow() const
  {
    if (this->First < this->Faults.size())
    {
      std::rethrow_exception(this->Faults[this->First]);
    }
  }

private:
  std::vector<std::exception_ptr> Faults;
  std::atomic<std::size_t> First;
};

/// Calls body(i) for each i in [0, count), possibly on several threads. If bodies throw, the exception
/// of the smallest i is rethrown, independent of the number of threads; later bodies may not have been
/// called.
template <typename Body>
void ForEach(const ParallelFor& parallelFor, std::size_t count, const Body& body)
{
  FirstFault fault(count);
  parallelFor(count,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end && !fault.IsBefore(i); ++i)
      {
        fault.Guard(i, body);
      }
    });
  fault.Rethrow();
}

}

#endif
