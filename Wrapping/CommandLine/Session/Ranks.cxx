// SPDX-License-Identifier: BSD-3-Clause
#include "Session/Ranks.h"

#include "Common/Error.h"
#include "Common/ParseNumber.h"

#include <vtkPolyData.h>

#ifdef FREESPACE_HAS_MPI
#include <vtkMPIController.h>
#include <vtkNew.h>
#endif

#include <cstdlib>
#include <string>

namespace freespace
{

namespace
{

// Open MPI's variables, and those of MPICH and its relatives.
int FromEnvironment(std::initializer_list<const char*> names, int otherwise)
{
  for (const char* name : names)
  {
    if (const char* text = std::getenv(name))
    {
      return ParseNumber<int>(text).value_or(otherwise);
    }
  }
  return otherwise;
}

}

int LaunchedRank()
{
  return FromEnvironment({ "OMPI_COMM_WORLD_RANK", "PMI_RANK" }, 0);
}

int LaunchedCount()
{
  return FromEnvironment({ "OMPI_COMM_WORLD_SIZE", "PMI_SIZE" }, 1);
}

#ifdef FREESPACE_HAS_MPI

namespace
{

enum Outcome : int
{
  Done = 0,
  Failed = 1,
  Stopped = 2
};

constexpr int surfaceTag = 4101;

}

struct Ranks::Processes
{
  vtkNew<vtkMPIController> controller;

  Processes() { this->controller->Initialize(nullptr, nullptr, 0); }
  ~Processes() { this->controller->Finalize(); }
};

Ranks::Ranks()
{
  if (LaunchedCount() > 1)
  {
    this->Others = std::make_unique<Processes>();
    this->Number = this->Others->controller->GetLocalProcessId();
    this->Size = this->Others->controller->GetNumberOfProcesses();
  }
}

void Ranks::Together(const std::function<void()>& work)
{
  if (!this->Others)
  {
    work();
    return;
  }
  int outcome = Done;
  std::string sentence;
  try
  {
    work();
  }
  catch (const Aborted&)
  {
    outcome = Stopped;
  }
  catch (const std::exception& error)
  {
    outcome = Failed;
    sentence = error.what();
  }
  std::vector<int> outcomes(this->Size);
  this->Others->controller->AllGather(&outcome, outcomes.data(), 1);
  int failed = -1;
  for (int rank = this->Size - 1; rank >= 0; --rank)
  {
    if (outcomes[rank] == Stopped)
    {
      throw Aborted();
    }
    failed = outcomes[rank] == Failed ? rank : failed;
  }
  if (failed >= 0)
  {
    int length = static_cast<int>(sentence.size());
    this->Others->controller->Broadcast(&length, 1, failed);
    sentence.resize(length);
    this->Others->controller->Broadcast(sentence.data(), length, failed);
    throw Error(sentence);
  }
}

std::vector<vtkSmartPointer<vtkPolyData>> Ranks::Gather(vtkPolyData* own)
{
  if (this->Number > 0)
  {
    this->Others->controller->Send(own, 0, surfaceTag);
    return {};
  }
  std::vector<vtkSmartPointer<vtkPolyData>> surfaces = { own };
  for (int rank = 1; rank < this->Size; ++rank)
  {
    surfaces.push_back(vtkSmartPointer<vtkPolyData>::New());
    this->Others->controller->Receive(surfaces.back(), rank, surfaceTag);
  }
  return surfaces;
}

#else

struct Ranks::Processes
{
};

Ranks::Ranks()
{
  if (LaunchedCount() > 1)
  {
    throw Error("This program was built without MPI: it runs in one process, without mpiexec.");
  }
}

void Ranks::Together(const std::function<void()>& work)
{
  work();
}

std::vector<vtkSmartPointer<vtkPolyData>> Ranks::Gather(vtkPolyData* own)
{
  return { own };
}

#endif

Ranks::~Ranks() = default;

}
