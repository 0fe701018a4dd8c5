// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/NeighborMatching.h"

#include "Common/Error.h"

#include <algorithm>

namespace freespace
{

void NeighborMatchingOptions::Check() const
{
  if (this->neighbors < 2)
  {
    throw Error("An image's edges are matched with those of two neighbours at least.");
  }
  if (!(this->tolerance > 0) || this->tokensPerImage < 1 || this->tracksPerImage < 1 ||
    this->tracks < 1)
  {
    throw Error(
      "The tolerance of matching with neighbours and its numbers of tokens and tracks must "
      "be positive.");
  }
}

std::size_t NeighborMatchingOptions::TracksOfEach(std::size_t images) const
{
  const std::size_t fewest = std::max<std::size_t>(1, this->tracksPerImage / 4);
  const std::size_t share = this->tracks / std::max<std::size_t>(1, images);
  return std::clamp(share, fewest, this->tracksPerImage);
}

}
