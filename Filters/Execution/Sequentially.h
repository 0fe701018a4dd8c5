// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Sequentially_h
#define freespace_Sequentially_h

#include <vtkSMPTools.h>

#include <string>
#include <utility>

namespace freespace
{

/// Runs a function on one thread of vtkSMPTools. For VTK's filters that list the cells of points by vtkStaticCellLinks:
/// from VTK 9.3 on it leaves the order of a list to the threads, and sums over the list round accordingly.
template <typename Function>
void Sequentially(Function&& function)
{
  vtkSMPTools::LocalScope(
    vtkSMPTools::Config(std::string("Sequential")), std::forward<Function>(function));
}

}

#endif
