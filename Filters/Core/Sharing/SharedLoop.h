// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SharedLoop_h
#define freespace_SharedLoop_h

#include "Common/CancellationFlag.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace freespace
{

/// A loop whose items processes share out. Each of them has the same one.
struct SharedLoop
{
  std::vector<double> work; ///< of each item, in any unit; those with the most are begun first

  /// Of equal work: whether items that follow each other need the same data, which a process then needs to
  /// read once: each begins at another place.
  bool areNeighborsAlike = false;

  /// Whether only the first process needs the values.
  bool isForFirst = false;

  /// Makes the value of an item, on one of the threads of one of the processes, and returns its bytes.
  std::function<std::string(std::size_t item, const CancellationFlag& stop)> make;

  /// Takes the bytes of an item, in the other processes.
  std::function<void(std::size_t item, const std::string& bytes)> take;
};

/// What became of an item.
struct MadeItem
{
  std::size_t item = 0;
  bool hasFailed = false;
  std::string bytes; ///< of its value, or the sentence of its exception
};

template <typename Bytes>
void Exchange(Bytes& bytes, MadeItem& made)
{
  bytes(made.item, made.hasFailed, made.bytes);
}

}

#endif
