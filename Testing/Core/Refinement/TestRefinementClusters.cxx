// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/RefinementClusters.h"

#include "Support/Scenes/PlanesScene.h"

#include <gtest/gtest.h>

using namespace freespace;

TEST(RefinementClusters, TakeTheNamedClustersImagesAlone)
{
  PlanesScene scene;
  scene.Scene.clusters.push_back({ "row", "c.png", { { "l.png", "c.png", "r.png" } } });
  const auto clusters = ClustersForRefinement(scene.Scene, scene.Exact, 4);
  ASSERT_EQ(clusters.size(), 3u);
  for (const Cluster& cluster : clusters)
  {
    ASSERT_EQ(cluster.triplets.size(), 1u);
    EXPECT_EQ(cluster.triplets[0][1], cluster.reference);
    EXPECT_NE(cluster.reference, "u.png");
  }
}
