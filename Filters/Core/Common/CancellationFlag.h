// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_CancellationFlag_h
#define freespace_CancellationFlag_h

#include "Common/Error.h"

#include <atomic>

namespace freespace
{

/// Set to stop a computation. Long computations check it regularly.
using CancellationFlag = std::atomic<bool>;

/// A flag that is never set.
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
