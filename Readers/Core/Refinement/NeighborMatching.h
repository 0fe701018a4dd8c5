// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_NeighborMatching_h
#define freespace_NeighborMatching_h

#include <cstddef>

namespace freespace
{

/// How the edges of each image are matched with those of its neighbours, before its cluster is matched for good:
/// the same for the check of the images and for the refinement of cameras, which share their tracks.
struct NeighborMatchingOptions
{
  int neighbors = 4; ///< images that an image's edges are matched with; >= 2
  double tolerance =
    1.5; ///< of a third image's confirmation, pixels: as far as the given cameras may be off; > 0
  std::size_t tokensPerImage = 12000; ///< edge tokens that are matched, about; > 0
  std::size_t tracksPerImage = 400;   ///< at most, that are kept of the matches; > 0
  std::size_t tracks =
    12000; ///< at most in a set of images, but a quarter of tracksPerImage for each; > 0

  /// How many tracks are kept of each of so many images: where there are many, each is constrained by several clusters.
  std::size_t TracksOfEach(std::size_t images) const;

  /// Throws Error when a field is out of its range.
  void Check() const;
};

}

#endif
