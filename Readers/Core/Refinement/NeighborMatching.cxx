// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/NeighborMatching.h"

#include "Common/Error.h"

namespace freespace
{

void NeighborMatchingOptions::Check() const
{
  if (this->neighbors < 2)
  {
    throw Error("An image's edges are matched with those of two neighbours at least.");
  }
  if (!(this->tolerance > 0) || this->tokensPerImage < 1 || this->tracksPerImage < 1)
  {
    throw Error(
      "The tolerance of matching with neighbours and its numbers of tokens and tracks must "
      "be positive.");
  }
}

}
