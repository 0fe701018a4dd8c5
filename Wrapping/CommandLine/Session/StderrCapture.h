// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_StderrCapture_h
#define freespace_StderrCapture_h

#include <string>
#include <vector>

namespace freespace
{

/// Keeps from the standard error, while it lives, what libraries write there by themselves: those that read
/// pictures do, beside telling the caller that they failed. Where the process is aborted it is written after
/// all. There may be one at a time.
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
