// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_CancellationFlag_h
#define freespace_CancellationFlag_h

#include "Common/Error.h"

#include <atomic>

namespace freespace
{

/// Set when a computation is to stop. Whoever works long looks at it now and then.
using CancellationFlag = std::atomic<bool>;

/// For those that nobody can stop.
inline const CancellationFlag NeverCancelled{ false };

/// Throws Aborted when the flag is set.
inline void ThrowIfCancelled(const CancellationFlag& stop)
{
  if (stop)
  {
    throw Aborted();
  }
}

}

#endif
