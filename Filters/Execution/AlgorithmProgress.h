// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_AlgorithmProgress_h
#define freespace_AlgorithmProgress_h

#include "Common/Progress.h"

#include <vtkAlgorithm.h>
#include <vtkDataObject.h>
#include <vtkVersionMacros.h>

namespace freespace
{

/// A core Progress that reports to a VTK algorithm and stops when its AbortExecute is set. From VTK 9.3 on the algorithms
/// downstream are told then, as by VTK's own.
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
