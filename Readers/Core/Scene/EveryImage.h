// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_EveryImage_h
#define freespace_EveryImage_h

#include "Scene/Scene.h"

#include <vector>

namespace freespace
{

/// Clusters of the same images in which every other image than the reference is the reference, too.
///
/// An extension of the paper, which uses the middle image of a cluster only: the others see parts of the
/// scene that are occluded in it. An image that stood at the end of a triplet is put in its
/// middle, and in that of all the cluster's other triplets. The new clusters are named after their
/// cluster and image. An image that is a reference already, or becomes one by an earlier cluster, is
/// not used again.
std::vector<Cluster> ClustersOfEveryImage(const std::vector<Cluster>& clusters);

}

#endif
