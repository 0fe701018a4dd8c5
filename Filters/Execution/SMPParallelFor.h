// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SMPParallelFor_h
#define freespace_SMPParallelFor_h

#include "Common/ParallelFor.h"

#include <vtkSMPTools.h>

namespace freespace
{

/// ParallelFor over vtkSMPTools, for the classes that call the core.
inline void SMPParallelFor(
  std::size_t count, const std::function<void(std::size_t begin, std::size_t end)>& body)
{
  vtkSMPTools::For(0, static_cast<vtkIdType>(count), 1,
    [&body](vtkIdType begin, vtkIdType end)
    { body(static_cast<std::size_t>(begin), static_cast<std::size_t>(end)); });
}

}

#endif
