// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Session_h
#define freespace_Session_h

#include <CLI/CLI.hpp>

#include <string>

class vtkAlgorithm;
class vtkWriter;

namespace freespace
{

/// What all commands share: the options --quiet and --threads, and running VTK algorithms so that
/// their progress is shown, their errors become one sentence and an interrupt stops them cleanly.
class Session
{
public:
  /// Adds the shared options to the program.
  void AddOptions(CLI::App& program);

  /// To be called once the command line is read.
  void Begin();

  /// Updates the algorithm under a stage's name. Throws Error with what the first error said.
  void Run(vtkAlgorithm* algorithm, const std::string& stage);

  /// Runs a writer. Throws Error like Run.
  void Write(vtkWriter* writer);

  /// Throws Error with the first VTK error since the last stage began, if there was one.
  void ThrowIfFailed();

  /// A line of the log, not shown when quiet.
  void Tell(const std::string& line) const;

  bool Quiet = false;
  int Threads = 0;
};

}

#endif
