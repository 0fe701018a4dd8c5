// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_StepProcess_h
#define freespace_StepProcess_h

#include <string>
#include <vector>

namespace freespace
{

/// The result of a process of the program.
struct StepEnd
{
  int process = 0;
  int status = 0;       ///< 0: it succeeded
  double mebibytes = 0; ///< most memory that it had
};

/// Starts this program with some arguments in a folder, its output into a log file, and returns its number. It ends
/// with this process, however that ends. Throws Error when it cannot be started.
int StartProgram(
  const std::vector<std::string>& arguments, const std::string& folder, const std::string& log);

/// Whether one of the processes has ended, and which; does not wait.
bool HasEnded(const std::vector<int>& processes, StepEnd& end);

/// Asks processes to stop and waits for them.
void StopAll(const std::vector<int>& processes);

}

#endif
