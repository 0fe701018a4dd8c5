// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_AlgorithmProgress_h
#define freespace_AlgorithmProgress_h

#include "Common/Progress.h"

#include <vtkAlgorithm.h>
#include <vtkDataObject.h>
#include <vtkVersionMacros.h>

namespace freespace
{

/// A core Progress that reports to a VTK algorithm and stops when its AbortExecute is set. VTK 9.3 tells the end of what
/// was stopped as progress, unless the output is said to be aborted.
inline Progress AlgorithmProgress(vtkAlgorithm* algorithm)
{
  return Progress(
    [algorithm](double fraction)
    {
      algorithm->UpdateProgress(fraction);
      const bool isStopped = algorithm->GetAbortExecute() != 0;
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
      algorithm->SetAbortOutput(isStopped);
#endif
      return !isStopped;
    });
}

}

#endif
