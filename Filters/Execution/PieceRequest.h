// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_PieceRequest_h
#define freespace_PieceRequest_h

#include "Common/Error.h"

#include <vtkInformation.h>
#include <vtkStreamingDemandDrivenPipeline.h>

namespace freespace
{

/// Throws Error where an output is wanted in pieces with ghost levels, which pieces of a contour do not have:
/// what is beyond a piece is not known before it is contoured.
inline void RefuseGhosts(vtkInformation* output)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  const auto get = [output](vtkInformationIntegerKey* key)
  { return output->Has(key) ? output->Get(key) : 0; };
  if (get(Pipeline::UPDATE_NUMBER_OF_PIECES()) > 1 &&
    get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()) > 0)
  {
    throw Error(
      "Pieces of the surface have no ghost levels: ask for none, and append the pieces with "
      "vtkAppendPiecesFilter before what needs the neighbors.");
  }
}

}

#endif
