// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/ProposeClusters.h"

#include "Support/SharedData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace freespace;

// The six crosses of the blocks scene, and all arcs of the vase's, are found without being told, the arcs
// among larger clusters.
TEST(ProposeClusters, ClustersOfTheSharedScenes)
{
  for (const std::string name : { "blocks", "charuco", "vase" })
  {
    const std::string file = SharedData(name + "/scene.json");
    if (file.empty())
    {
      GTEST_SKIP() << "no shared data";
    }
    const Scene scene = ReadScene(file);
    const SparseModel model = ReadSceneModel(scene);
    const std::vector<Cluster> found =
      ClustersFromProposal(model, ProposeClusters(model, {}).clusters);
    EXPECT_GE(found.size(), scene.clusters.size()) << name;
    for (const Cluster& expected : scene.clusters)
    {
      const auto same = std::find_if(found.begin(), found.end(),
        [&](const Cluster& cluster) { return cluster.reference == expected.reference; });
      ASSERT_NE(same, found.end()) << name << ": " << expected.reference;
      std::set<std::string> members;
      for (const std::array<std::string, 3>& triplet : same->triplets)
      {
        members.insert(triplet.begin(), triplet.end());
      }
      for (const std::array<std::string, 3>& triplet : expected.triplets)
      {
        EXPECT_EQ(members.count(triplet[0]), 1u) << name << ": " << expected.reference;
        EXPECT_EQ(members.count(triplet[2]), 1u) << name << ": " << expected.reference;
      }
    }
  }
}
