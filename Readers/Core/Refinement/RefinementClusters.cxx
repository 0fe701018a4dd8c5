// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/RefinementClusters.h"

#include "Scene/ImageNeighborhoods.h"
#include "Scene/SceneClusters.h"

#include <algorithm>
#include <set>

namespace freespace
{

namespace
{

// Wider than for matching alone: large angles between rays constrain the poses of the cameras.
ClusterProposalOptions NeighborOptions()
{
  ClusterProposalOptions options;
  options.preferredAngle = 8;
  options.maximumAngle = 25;
  return options;
}

SparseModel WithImagesOfClusters(const std::vector<Cluster>& clusters, SparseModel model)
{
  std::set<std::string> files;
  for (const Cluster& cluster : clusters)
  {
    for (const auto& triplet : cluster.triplets)
    {
      files.insert(triplet.begin(), triplet.end());
    }
  }
  const auto isOther = [&](const SparseImage& image) { return files.count(image.name) == 0; };
  model.images.erase(
    std::remove_if(model.images.begin(), model.images.end(), isOther), model.images.end());
  return model;
}

}

std::vector<Cluster> ClustersForRefinement(const Scene& scene, SparseModel model, int neighbors)
{
  model = scene.clusters.empty() ? WithExistingPhotographs(scene, std::move(model))
                                 : WithImagesOfClusters(scene.clusters, std::move(model));
  const ImageNeighborhoods neighborhoods(model, NeighborOptions());
  std::vector<Cluster> clusters;
  for (std::size_t i = 0; i < model.images.size(); ++i)
  {
    std::vector<Neighbor> others = neighborhoods.NeighborsOf(i);
    others.resize(std::min<std::size_t>(others.size(), neighbors));
    if (others.size() < 2)
    {
      continue;
    }
    const std::string& reference = model.images[i].name;
    Cluster& cluster = clusters.emplace_back();
    cluster.name = cluster.reference = reference;
    for (std::size_t k = 0; k < others.size(); k += 2)
    {
      const std::size_t second = k + 1 < others.size() ? k + 1 : 0;
      cluster.triplets.push_back(
        { model.images[others[k].image].name, reference, model.images[others[second].image].name });
    }
  }
  return clusters;
}

}
