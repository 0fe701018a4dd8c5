// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Ranks_h
#define freespace_Ranks_h

#include <vtkSmartPointer.h>

#include <functional>
#include <memory>
#include <vector>

class vtkPolyData;

namespace freespace
{

/// The rank of this process and the number of processes that `mpiexec` started: 0 of 1 without mpiexec.
/// Read from the environment, so that MPI need not be initialized.
int LaunchedRank();
int LaunchedCount();

/// The processes that share the work of a command: MPI's, if mpiexec started several, otherwise one without
/// MPI. Throws Error when there are several, but the program was built without MPI.
class Ranks
{
public:
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int Rank() const { return this->Number; }
  int Count() const { return this->Size; }

  /// Runs work on every rank. When it throws on any, this throws on all: Aborted if it did anywhere,
  /// else an Error with the sentence of the first rank that failed.
  void Together(const std::function<void()>& work);

  /// The surfaces of all ranks in their order, on rank 0; nothing on the others.
  std::vector<vtkSmartPointer<vtkPolyData>> Gather(vtkPolyData* own);

private:
  int Number = 0;
  int Size = 1;
  struct Processes;
  std::unique_ptr<Processes> Others; ///< null when there are none
};

}

#endif
