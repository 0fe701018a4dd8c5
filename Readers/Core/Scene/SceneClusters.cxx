// SPDX-License-Identifier: BSD-3-Clause
#include "Files/PathChecks.h"
#include "Scene/SceneClusters.h"

#include "Common/Error.h"

#include <algorithm>
#include <filesystem>

namespace freespace
{

SparseModel WithExistingPhotographs(const Scene& scene, SparseModel model)
{
  if (scene.pixels || !IsFolder(scene.ImagesFolder()))
  {
    return model;
  }
  const std::size_t all = model.images.size();
  model.images.erase(
    std::remove_if(model.images.begin(), model.images.end(),
      [&](const SparseImage& image) { return !IsThere(scene.ImagePath(image.name)); }),
    model.images.end());
  if (model.images.empty() && all > 0)
  {
    throw Error("None of the " + std::to_string(all) + " images of " + scene.ModelFolder() +
      " is in the folder " + scene.ImagesFolder() + ".");
  }
  return model;
}

Scene WithProposedClusters(
  Scene scene, const SparseModel& all, const ClusterProposalOptions& options, std::string* choice)
{
  const SparseModel model = WithExistingPhotographs(scene, all);
  const ClusterProposal proposal = ProposeClusters(model, options);
  if (proposal.Empty())
  {
    throw Error("The scene " + scene.file +
      " has no clusters, and none can be proposed: no image has two neighbours that see the "
      "same.");
  }
  scene.clusters = ClustersFromProposal(model, proposal.clusters);
  if (choice)
  {
    *choice = DescribeChoice(model, proposal);
  }
  return scene;
}

Scene ReadSceneWithClusters(
  const std::string& file, const ClusterProposalOptions& options, std::string* choice)
{
  Scene scene = ReadScene(file);
  return scene.clusters.empty()
    ? WithProposedClusters(scene, ReadSceneModel(scene), options, choice)
    : scene;
}

}
