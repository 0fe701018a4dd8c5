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

/// For the catch (...) that ends a RequestData: empties the output, tells VTK what the core threw and
/// gives the value to return. A stop on request is no error.
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
