// SPDX-License-Identifier: BSD-3-Clause
#include "RunWriter.h"

#include "Common/Error.h"
#include "Files/AtomicOutput.h"

#include <vtkErrorCode.h>
#include <vtkWriter.h>

namespace freespace
{

unsigned long RunWriter(
  vtkWriter* writer, const std::string& fileName, const std::function<void()>& write)
{
  try
  {
    write();
    return vtkErrorCode::NoError;
  }
  catch (const Aborted&)
  {
    return vtkErrorCode::UserError;
  }
  catch (const NoRoom& error)
  {
    vtkErrorWithObjectMacro(writer, << error.what());
    return vtkErrorCode::OutOfDiskSpaceError;
  }
  catch (const std::exception& error)
  {
    vtkErrorWithObjectMacro(writer, << error.what());
    return fileName.empty() ? vtkErrorCode::NoFileNameError : vtkErrorCode::CannotOpenFileError;
  }
}

}
