// SPDX-License-Identifier: BSD-3-Clause
#include "Session/StderrCapture.h"

#include <algorithm>
#include <csignal>
#include <sstream>

#include <sys/mman.h>
#include <unistd.h>

namespace freespace
{

namespace
{

int standardError = -1; // as it was; -1: there is nothing to keep
int kept = -1;

// Writes the captured text piece by piece; safe in a signal handler.
template <typename Visit>
void ForEachPiece(const Visit& visit)
{
  char piece[4096];
  off_t at = 0;
  for (ssize_t size = 0; (size = pread(kept, piece, sizeof piece, at)) > 0; at += size)
  {
    visit(piece, size);
  }
}

void OnAbort(int signal)
{
  std::signal(signal, SIG_DFL);
  ForEachPiece(
    [](const char* piece, ssize_t size)
    {
      if (write(standardError, piece, size) < 0)
      {
        // There is nobody left to tell.
      }
    });
  raise(signal);
}

}

StderrCapture::StderrCapture()
{
#ifndef __SANITIZE_ADDRESS__ // whose words matter
  kept = memfd_create("freespace-words", MFD_CLOEXEC);
  standardError = kept < 0 ? -1 : dup(STDERR_FILENO);
  if (standardError >= 0)
  {
    dup2(kept, STDERR_FILENO);
    std::signal(SIGABRT, OnAbort);
  }
#endif
}

StderrCapture::~StderrCapture()
{
  if (standardError >= 0)
  {
    std::signal(SIGABRT, SIG_DFL);
    dup2(standardError, STDERR_FILENO);
    close(standardError);
    standardError = -1;
  }
  if (kept >= 0)
  {
    close(kept);
    kept = -1;
  }
}

int StderrCapture::RealDescriptor()
{
  const int real = standardError;
  return real >= 0 ? real : STDERR_FILENO;
}

std::vector<std::string> StderrCapture::Lines() const
{
  std::string all;
  ForEachPiece([&all](const char* piece, ssize_t size) { all.append(piece, size); });
  std::istringstream text(all);
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);)
  {
    if (!line.empty() && std::find(lines.begin(), lines.end(), line) == lines.end())
    {
      lines.push_back(line);
    }
  }
  return lines;
}

}
