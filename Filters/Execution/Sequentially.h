// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Sequentially_h
#define freespace_Sequentially_h

#include <vtkSMPTools.h>

#include <mutex>
#include <string>
#include <utility>

namespace freespace
{

/// Held while vtkSMPTools is set to one thread, which it is for the whole process: whoever came second would otherwise
/// restore that.
inline std::recursive_mutex& SequentialMutex()
{
  static std::recursive_mutex mutex;
  return mutex;
}

/// Runs a function on one thread of vtkSMPTools. For VTK's filters that list the cells of points by vtkStaticCellLinks:
/// from VTK 9.3 on it leaves the order of a list to the threads, and sums over the list round accordingly.
template <typename Function>
void Sequentially(Function&& function)
{
  const std::lock_guard<std::recursive_mutex> lock(SequentialMutex());
  vtkSMPTools::LocalScope(
    vtkSMPTools::Config(std::string("Sequential")), std::forward<Function>(function));
}

}

#endif
