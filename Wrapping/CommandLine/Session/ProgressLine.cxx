// SPDX-License-Identifier: BSD-3-Clause
#include "Session/ProgressLine.h"

#include <algorithm>
#include <cstdio>

#include <unistd.h>

namespace freespace
{

namespace
{
constexpr int barWidth = 40;
}

ProgressLine::ProgressLine(const std::string& stage, bool quiet)
  : Stage(stage)
  , Look(quiet                  ? Style::None
        : isatty(STDERR_FILENO) ? Style::Bar
                                : Style::Lines)
  , Out(fdopen(dup(STDERR_FILENO), "w"))
{
  if (!this->Out)
  {
    this->Look = Style::None;
  }
  this->Show(0);
}

ProgressLine::~ProgressLine()
{
  if (this->Look == Style::Bar)
  {
    std::fprintf(this->Out, "\r\033[K"); // leaves no unfinished bar behind
  }
  if (this->Out)
  {
    std::fclose(this->Out);
  }
}

void ProgressLine::Show(double fraction)
{
  const int percent = static_cast<int>(100 * std::clamp(fraction, 0.0, 1.0));
  const int step = this->Look == Style::Bar ? 1 : 25;
  // A filter within the stage may start again at 0, but the bar never goes back.
  if (this->Look == Style::None || percent < this->Shown + step)
  {
    return;
  }
  this->Shown = percent - percent % step;
  if (this->Look == Style::Bar)
  {
    const std::string bar(percent * barWidth / 100, '=');
    std::fprintf(
      this->Out, "\r%-12s [%-*s] %3d%%", this->Stage.c_str(), barWidth, bar.c_str(), percent);
  }
  else if (this->Shown > 0 && this->Shown < 100)
  {
    std::fprintf(this->Out, "%s: %d%%\n", this->Stage.c_str(), this->Shown);
  }
  std::fflush(this->Out);
}

void ProgressLine::Finish()
{
  if (this->Look == Style::None)
  {
    return;
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - this->Started;
  std::fprintf(this->Out, "%s%s: done in %.1f s\n", this->Look == Style::Bar ? "\r\033[K" : "",
    this->Stage.c_str(), taken.count());
  std::fflush(this->Out);
  this->Look = Style::None;
}

}
