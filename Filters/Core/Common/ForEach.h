// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ForEach_h
#define freespace_ForEach_h

#include "Common/ParallelFor.h"

#include <atomic>
#include <exception>
#include <vector>

namespace freespace
{

/// Of what the bodies of a parallel loop throw, that of the least index: the same for any number of
/// threads.
class FirstFault
{
public:
  explicit FirstFault(std::size_t count)
    : Faults(count)
    , First(count)
  {
  }

  /// Whether a lesser index has thrown: what i does is of no use any more.
  bool IsBefore(std::size_t i) const { return this->First < i; }

  /// Calls body(i) and keeps what it throws.
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

  /// Throws it on, if there was one, once the loop has ended.
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

/// Calls body(i) for each i in [0, count), perhaps on several threads. Where bodies throw, what the one
/// of the least i threw is thrown on, the same for any number of threads; what comes after it may not be
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
