// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_StderrCapture_h
#define freespace_StderrCapture_h

#include <string>
#include <vector>

namespace freespace
{

/// Captures, during its lifetime, what libraries write to the standard error: image libraries do, in addition
/// to returning an error. If the process is aborted, the captured text is written. Only one may exist at a
/// time.
class StderrCapture
{
public:
  StderrCapture();
  ~StderrCapture();
  StderrCapture(const StderrCapture&) = delete;
  StderrCapture& operator=(const StderrCapture&) = delete;

  /// The lines so far, each once.
  std::vector<std::string> Lines() const;

  /// The standard error's descriptor, also while one lives.
  static int RealDescriptor();
};

}

#endif
