// SPDX-License-Identifier: BSD-3-Clause
#include "Session/Ranks.h"

#include "Common/Error.h"
#include "Common/ParseNumber.h"
#include "Sharing/ProcessMessages.h"
#include "Sharing/SharedWork.h"

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
constexpr const char* rankNames[] = { "OMPI_COMM_WORLD_RANK", "PMI_RANK" };
constexpr const char* countNames[] = { "OMPI_COMM_WORLD_SIZE", "PMI_SIZE" };

int FromEnvironment(const char* const (&names)[2], int otherwise)
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
  return FromEnvironment(rankNames, 0);
}

int LaunchedCount()
{
  return FromEnvironment(countNames, 1);
}

void ForgetLaunch()
{
  for (int i = 0; i < 2; ++i)
  {
    unsetenv(rankNames[i]);
    unsetenv(countNames[i]);
  }
}

#ifdef FREESPACE_HAS_MPI

class Ranks::Processes : public ProcessMessages
{
public:
  Processes() { this->Controller->Initialize(nullptr, nullptr, 0); }
  ~Processes() override { this->Controller->Finalize(); }

  int Rank() const override { return this->Controller->GetLocalProcessId(); }
  int Count() const override { return this->Controller->GetNumberOfProcesses(); }

  void Send(int to, const std::string& message) override
  {
    const auto size = static_cast<vtkIdType>(message.size());
    this->Controller->Send(&size, 1, to, Tag);
    this->Controller->Send(message.data(), size, to, Tag);
  }

  bool Receive(int& from, std::string& message) override
  {
    int isThere = 0;
    this->Controller->Iprobe(vtkMultiProcessController::ANY_SOURCE, Tag, &isThere, &from);
    if (!isThere)
    {
      return false;
    }
    vtkIdType size = 0;
    this->Controller->Receive(&size, 1, from, Tag);
    message.resize(size);
    this->Controller->Receive(message.data(), size, from, Tag);
    return true;
  }

private:
  static constexpr int Tag = 4101;
  vtkNew<vtkMPIController> Controller;
};

#else

class Ranks::Processes : public ProcessMessages
{
public:
  Processes()
  {
    throw Error("This program was built without MPI: it runs in one process, without mpiexec.");
  }
  int Rank() const override { return 0; }
  int Count() const override { return 1; }
  void Send(int, const std::string&) override {}
  bool Receive(int&, std::string&) override { return false; }
};

#endif

Ranks::Ranks()
{
  if (LaunchedCount() > 1)
  {
    this->Others = std::make_unique<Processes>();
    if (this->Others->Count() != LaunchedCount())
    {
      throw Error(
        "This program was built with another MPI than that of the mpiexec that has started it.");
    }
    this->Shared = std::make_unique<SharedWork>(*this->Others);
  }
}

Ranks::~Ranks() = default;

}
