// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Ranks_h
#define freespace_Ranks_h

#include <memory>

namespace freespace
{

class SharedWork;

/// The rank of this process and the number of processes that `mpiexec` started: 0 of 1 without mpiexec.
/// Read from the environment, so that MPI need not be initialized.
int LaunchedRank();
int LaunchedCount();

/// For a process that is to start others which are none of mpiexec's: they see themselves as alone.
void ForgetLaunch();

/// The processes that share the work of a command: MPI's, if mpiexec started several, otherwise one without
/// MPI. Throws Error when there are several, but the program was built without MPI.
class Ranks
{
public:
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  /// Null where this process is alone.
  SharedWork* Work() const { return this->Shared.get(); }

private:
  class Processes;
  std::unique_ptr<Processes> Others; // null when there are none
  std::unique_ptr<SharedWork> Shared;
};

}

#endif
