// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_StopFlag_h
#define freespace_StopFlag_h

#include "Error.h"

#include <atomic>

namespace freespace
{

/// Set when a computation is to stop. Whoever works long looks at it now and then.
using StopFlag = std::atomic<bool>;

/// For those that nobody can stop.
inline const StopFlag NeverStopped{ false };

/// Throws Aborted when the flag is set.
inline void ThrowIfStopped(const StopFlag& stop)
{
  if (stop)
  {
    throw Aborted();
  }
}

}

#endif
