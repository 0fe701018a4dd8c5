// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ReferenceChoice_h
#define freespace_ReferenceChoice_h

#include "Scene/ImageNeighborhoods.h"

#include <vector>

namespace freespace
{

/// An image that can be a reference.
struct PossibleReference
{
  int image = 0;
  double quality = 0; ///< of its cluster
};

/// Chooses references such that everything that is seen stays covered: first far apart, the best first,
/// then between these at smaller and smaller distances, down to the separation. An
/// image is left out when a reference stands nearer than that and sees most of the same, or when as
/// many references as the options' coverage, none farther than the coverage angle, do. Returns images in
/// ascending order. The time is O(n log n) if the number of references near an image is bounded.
std::vector<int> ChooseReferences(const ImageNeighborhoods& images,
  std::vector<PossibleReference> possible, const ClusterProposalOptions& options);

}

#endif
