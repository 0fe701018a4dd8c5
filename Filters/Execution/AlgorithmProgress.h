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

/// For the catch (...) at the end of a RequestData: empties the output, reports the core's exception as a
/// VTK error and returns the value to return. An abort is not an error.
inline int AfterException(vtkAlgorithm* algorithm, vtkDataObject* output)
{
  output->Initialize();
  try
  {
    throw;
  }
  catch (const Aborted&)
  {
    return 1;
  }
  catch (const std::exception& error)
  {
    vtkErrorWithObjectMacro(algorithm, << error.what());
  }
  return 0;
}

}

#endif
