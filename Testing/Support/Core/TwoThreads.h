// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_TwoThreads_h
#define freespace_TwoThreads_h

#include <cstddef>
#include <functional>
#include <thread>

namespace freespace
{

/// A ParallelFor of two threads, each of which has one half.
inline void TwoThreads(
  std::size_t count, const std::function<void(std::size_t begin, std::size_t end)>& body)
{
  std::thread other([&] { body(0, count / 2); });
  body(count / 2, count);
  other.join();
}

}

#endif
