// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_AlgorithmErrors_h
#define freespace_AlgorithmErrors_h

#include "Common/Error.h"

#include <vtkAlgorithm.h>
#include <vtkDataObject.h>
#include <vtkDemandDrivenPipeline.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkInformation.h>
#include <vtksys/SystemTools.hxx>

#include <string>

namespace freespace
{

/// Sets an algorithm's error code, which only its class may do otherwise.
inline void SetErrorCodeOf(vtkAlgorithm* algorithm, unsigned long code)
{
  struct Access : vtkAlgorithm
  {
    static void Set(vtkAlgorithm* to, unsigned long value) { (to->*&Access::SetErrorCode)(value); }
  };
  Access::Set(algorithm, code);
}

/// For a catch (...): the error code of a reader that failed, by its file.
inline unsigned long ErrorCodeOf(const std::string& fileName)
{
  try
  {
    throw;
  }
  catch (const Aborted&)
  {
    return vtkErrorCode::NoError;
  }
  catch (...)
  {
    using Tools = vtksys::SystemTools;
    return fileName.empty()                                      ? vtkErrorCode::NoFileNameError
      : !Tools::PathExists(fileName)                             ? vtkErrorCode::FileNotFoundError
      : !Tools::TestFileAccess(fileName, vtksys::TEST_FILE_READ) ? vtkErrorCode::CannotOpenFileError
                                                                 : vtkErrorCode::FileFormatError;
  }
}

/// Ends a RequestData that has reported an error: empties the outputs and marks them as not generated. VTK
/// would take them for up to date, and a second update would report nothing. Sets the error code where the class
/// has set none: UserError, since it is the input or a setting that is wrong. Returns the value to return.
inline int AfterError(vtkAlgorithm* algorithm)
{
  if (algorithm->GetErrorCode() == vtkErrorCode::NoError)
  {
    SetErrorCodeOf(algorithm, vtkErrorCode::UserError);
  }
  for (int port = 0; port < algorithm->GetNumberOfOutputPorts(); ++port)
  {
    vtkInformation* information = algorithm->GetExecutive()->GetOutputInformation(port);
    if (vtkDataObject* output = vtkDataObject::GetData(information))
    {
      output->ReleaseData();
      information->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
    }
  }
  return 0;
}

/// For the catch (...) at the end of a RequestData: empties the outputs, reports the core's exception as a
/// VTK error and returns the value to return. An abort is not an error.
inline int AfterException(vtkAlgorithm* algorithm)
{
  try
  {
    throw;
  }
  catch (const Aborted&)
  {
    for (int port = 0; port < algorithm->GetNumberOfOutputPorts(); ++port)
    {
      algorithm->GetOutputDataObject(port)->Initialize();
    }
    return 1;
  }
  catch (const std::exception& error)
  {
    vtkErrorWithObjectMacro(algorithm, << error.what());
  }
  return AfterError(algorithm);
}

}

#endif
