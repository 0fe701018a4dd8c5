// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ErrorCollector_h
#define freespace_ErrorCollector_h

#include <vtkOutputWindow.h>

#include <mutex>
#include <string>
#include <vector>

namespace freespace
{

/// Collects VTK's messages without their file names, line numbers and addresses. Errors are kept, because a
/// command reports the first one and ends; warnings are kept until they are taken.
class ErrorCollector : public vtkOutputWindow
{
public:
  static ErrorCollector* New();
  vtkTypeMacro(ErrorCollector, vtkOutputWindow);

  void DisplayErrorText(const char* text) override;
  void DisplayWarningText(const char* text) override;
  void DisplayGenericWarningText(const char* text) override;

  /// The first error since Clear, or an empty string.
  std::string FirstError();
  void Clear();

  /// The warnings since this was called last.
  std::vector<std::string> TakeWarnings();

private:
  std::mutex Mutex;
  std::string First, Poor;
  std::vector<std::string> Warnings;
};

}

#endif
