// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_RefinementClusters_h
#define freespace_RefinementClusters_h

#include "Scene/Scene.h"

#include <vector>

namespace freespace
{

/// Clusters whose matches tie the cameras of a scene together: one around each image, of the (at most)
/// `neighbors` images that suit it best. Where the scene names clusters, their images alone, else those
/// of the model whose photographs are there. An image with fewer than two neighbours has none.
std::vector<Cluster> ClustersForRefinement(const Scene& scene, SparseModel model, int neighbors);

}

#endif
