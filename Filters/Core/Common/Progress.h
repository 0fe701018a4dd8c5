// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Progress_h
#define freespace_Progress_h

#include "Common/Error.h"

#include <functional>

namespace freespace
{

/// Reports the progress of a computation and lets the caller stop it. To be called only from the thread
/// that started the computation.
class Progress
{
public:
  /// The function receives the fraction done, in [0, 1], and returns false to stop.
  using Function = std::function<bool(double)>;

  Progress() = default;
  Progress(Function report)
    : Report(std::move(report))
  {
  }

  /// Throws Aborted when the caller wants to stop.
  void operator()(double fraction) const
  {
    if (this->Report && !this->Report(fraction))
    {
      throw Aborted();
    }
  }

  /// The part of this progress from `begin` to `end`, as a progress of its own.
  Progress Part(double begin, double end) const
  {
    return Progress(
      [whole = *this, begin, end](double fraction)
      {
        whole(begin + fraction * (end - begin));
        return true;
      });
  }

private:
  Function Report;
};

}

#endif
