// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ProgressWatch_h
#define freespace_ProgressWatch_h

#include <vtkAlgorithm.h>
#include <vtkCommand.h>
#include <vtkFreespaceUnion.h>

#include <algorithm>
#include <functional>

namespace freespace
{

/// Records the progress of an algorithm and aborts the algorithm when it has reached a value.
class ProgressWatch
{
public:
  ProgressWatch(vtkAlgorithm* algorithm, double stopAt)
    : Algorithm(algorithm)
    , StopAt(stopAt)
  {
    this->Tag = algorithm->AddObserver(vtkCommand::ProgressEvent, this, &ProgressWatch::See);
  }
  ~ProgressWatch() { this->Algorithm->RemoveObserver(this->Tag); }

  double Last = 0, Greatest = 0;
  int Steps = 0, After = 0;
  bool IsMonotone = true;
  std::function<void()> AtStop;

private:
  void See(vtkObject*, unsigned long, void* data)
  {
    const double value = *static_cast<double*>(data);
    this->IsMonotone = this->IsMonotone && value >= this->Last;
    this->Greatest = std::max(this->Greatest, value - this->Last);
    this->Steps += value > this->Last;
    this->After += this->Algorithm->GetAbortExecute() != 0 && value < 1;
    this->Last = value;
    if (value >= this->StopAt)
    {
      this->Algorithm->SetAbortExecute(1);
      if (this->AtStop)
      {
        this->AtStop();
      }
    }
  }

  vtkAlgorithm* Algorithm;
  double StopAt;
  unsigned long Tag;
};

/// Aborts the building of a function, or what is done after it, at the n-th progress event there.
class Stopper
{
public:
  Stopper(vtkObject* worker, vtkFreespaceUnion* phi, bool inBuilding, int at)
    : Phi(phi)
    , IsInBuilding(inBuilding)
    , Left(at)
  {
    worker->AddObserver(vtkCommand::ProgressEvent, this, &Stopper::See);
  }

  bool HasStopped = false;
  int After = 0;

private:
  void See(vtkObject* caller, unsigned long, void* fraction)
  {
    // The last event is the pipeline's own, with VTK 9.3 after an abort, too.
    this->After += this->HasStopped && *static_cast<double*>(fraction) < 1;
    if (this->Phi->IsBuilt() != this->IsInBuilding && this->Left-- == 1)
    {
      this->HasStopped = true;
      auto* algorithm = vtkAlgorithm::SafeDownCast(caller);
      algorithm ? algorithm->SetAbortExecute(1) : this->Phi->SetAbortExecute(1);
    }
  }

  vtkFreespaceUnion* Phi;
  bool IsInBuilding;
  int Left;
};

}

#endif
