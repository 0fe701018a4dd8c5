// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/SceneClusters.h"

#include "Common/Error.h"

#include <algorithm>
#include <filesystem>

namespace freespace
{

SparseModel WithExistingPhotographs(const Scene& scene, SparseModel model)
{
  if (!std::filesystem::is_directory(scene.ImagesFolder()))
  {
    return model;
  }
  model.images.erase(std::remove_if(model.images.begin(), model.images.end(),
                       [&](const SparseImage& image)
                       { return !std::filesystem::exists(scene.ImagePath(image.name)); }),
    model.images.end());
  return model;
}

Scene ReadSceneWithClusters(
  const std::string& file, const ClusterProposalOptions& options, std::string* choice)
{
  Scene scene = ReadScene(file);
  if (scene.clusters.empty())
  {
    const SparseModel model = WithExistingPhotographs(scene, ReadSceneModel(scene));
    const ClusterProposal proposal = ProposeClusters(model, options);
    if (proposal.Empty())
    {
      throw Error("The scene " + file +
        " has no clusters, and none can be proposed: no photograph has two neighbours that see the "
        "same.");
    }
    scene.clusters = ClustersFromProposal(model, proposal.clusters);
    if (choice)
    {
      *choice = DescribeChoice(model, proposal);
    }
  }
  return scene;
}

}
