// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_RefinementClusters_h
#define freespace_RefinementClusters_h

#include "Scene/Scene.h"

#include <vector>

namespace freespace
{

/// Clusters whose matches tie the cameras of a scene together: one around each image, of at most
/// `neighbors` images that match it best. Only the images of the scene's clusters if it names any, else those
/// of the model whose files exist. An image with fewer than two neighbours has none.
std::vector<Cluster> ClustersForRefinement(const Scene& scene, SparseModel model, int neighbors);

}

#endif
