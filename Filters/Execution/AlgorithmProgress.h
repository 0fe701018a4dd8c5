// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_AlgorithmProgress_h
#define freespace_AlgorithmProgress_h

#include "Common/Progress.h"

#include <vtkAlgorithm.h>
#include <vtkDataObject.h>

namespace freespace
{

/// A core Progress that reports to a VTK algorithm and stops when its AbortExecute is set.
inline Progress AlgorithmProgress(vtkAlgorithm* algorithm)
{
  return Progress(
    [algorithm](double fraction)
    {
      algorithm->UpdateProgress(fraction);
      return algorithm->GetAbortExecute() == 0;
    });
}

}

#endif
