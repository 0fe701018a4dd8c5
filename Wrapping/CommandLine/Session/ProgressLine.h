// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ProgressLine_h
#define freespace_ProgressLine_h

#include <chrono>
#include <cstdio>
#include <string>

namespace freespace
{

/// The progress of a stage on standard error: a redrawn bar on a terminal, a plain line at each quarter in
/// a log, nothing when quiet. It goes where the standard error went when the stage began.
class ProgressLine
{
public:
  ProgressLine(const std::string& stage, bool quiet);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// The fraction done, in [0, 1].
  void Show(double fraction);

  /// The stage has succeeded: prints its time.
  void Finish();

private:
  enum class Style
  {
    None,
    Lines,
    Bar
  };

  std::string Stage;
  Style Look;
  std::FILE* Out;
  int Shown = -1; // percent
  std::chrono::steady_clock::time_point Started = std::chrono::steady_clock::now();
};

}

#endif
