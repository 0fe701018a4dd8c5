// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_WatchedUpdate_h
#define freespace_WatchedUpdate_h

#include "Common/Progress.h"

#include <vtkAlgorithm.h>
#include <vtkCommand.h>

namespace freespace
{

/// Updates an algorithm, which is aborted when the progress stops it.
class WatchedUpdate
{
public:
  WatchedUpdate(vtkAlgorithm* algorithm, const Progress& progress)
    : Algorithm(algorithm)
    , Told(progress)
  {
  }

  void Run(int port)
  {
    const unsigned long tag =
      this->Algorithm->AddObserver(vtkCommand::ProgressEvent, this, &WatchedUpdate::See);
    this->Algorithm->Update(port);
    this->Algorithm->RemoveObserver(tag);
    if (this->IsStopped)
    {
      this->Algorithm->SetAbortExecute(0); // which VTK 9.3 leaves to who has set it
      this->Algorithm->Modified();         // its output is not what it should be
      throw Aborted();
    }
  }

private:
  void See(vtkObject*, unsigned long, void* fraction)
  {
    try
    {
      this->Told(*static_cast<double*>(fraction));
    }
    catch (const Aborted&)
    {
      this->IsStopped = true;
      this->Algorithm->SetAbortExecute(1);
    }
  }

  vtkAlgorithm* Algorithm;
  const Progress& Told;
  bool IsStopped = false;
};

}

#endif
