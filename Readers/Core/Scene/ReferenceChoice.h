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

/// Chooses the references that are worth their time, such that all that is seen stays covered:
/// first far apart, the best first, then between these nearer and nearer, down to the separation. An
/// image is left out when a reference stands nearer than that and sees most of the same, or when as
/// many references as the options' coverage, none farther than the coverage angle, do. Returns images in
/// ascending order. The time is that of n log n with a bounded number of references about an image.
std::vector<int> ChooseReferences(const ImageNeighborhoods& images,
  std::vector<PossibleReference> possible, const ClusterProposalOptions& options);

}

#endif
