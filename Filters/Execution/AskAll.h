// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_AskAll_h
#define freespace_AskAll_h

#include "Common/ParallelForWithProgress.h"
#include "Execution/SMPParallelFor.h"
#include "Freespace/FreespaceUnion.h"

#include <vtkDataArray.h>

#include <algorithm>

namespace freespace
{

using MakeIndex = void (FreespaceUnion::*)(const Progress&) const;

/// Calls ask(core, i) for all of a batch on all threads, once the function is up to date and has the
/// index that is needed. False, with no results, when the progress wanted to stop.
template <typename Union, typename Ask>
bool AskAll(Union* phi, const Progress& progress, MakeIndex makeIndex, vtkIdType count,
  vtkDataArray* results, const Ask& ask)
{
  constexpr vtkIdType chunkSize = 1024;
  constexpr double buildingShare = 0.5; // of the progress, between building and asking
  const double built = phi->IsBuilt() ? 0.0 : buildingShare;
  results->SetNumberOfComponents(1);
  results->SetNumberOfTuples(count);
  try
  {
    const auto core = phi->GetCore(progress.Part(0.0, 0.9 * built));
    if (core)
    {
      (core.get()->*makeIndex)(progress.Part(0.9 * built, built));
    }
    ParallelForWithProgress(static_cast<std::size_t>((count + chunkSize - 1) / chunkSize),
      SMPParallelFor, progress.Part(built, 1.0),
      [&](std::size_t chunk, const CancellationFlag& stop)
      {
        const vtkIdType begin = static_cast<vtkIdType>(chunk) * chunkSize;
        for (vtkIdType i = begin; i < std::min(begin + chunkSize, count); ++i)
        {
          ThrowIfCancelled(stop);
          ask(core.get(), i);
        }
      });
  }
  catch (const Aborted&)
  {
    results->Initialize();
    return false;
  }
  return true;
}

}

#endif
