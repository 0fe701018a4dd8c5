// SPDX-License-Identifier: BSD-3-Clause
#include "Agreement/RemainingImages.h"

#include <algorithm>

namespace freespace
{

namespace
{

// Puts each of the images that stand in no triplet yet into one, beside another such or any other.
void AddTriplets(const std::vector<std::string>& others, Cluster& cluster)
{
  std::vector<std::string> loose;
  for (const std::string& image : others)
  {
    const auto holds = [&image](const auto& triplet)
    { return triplet[0] == image || triplet[2] == image; };
    if (std::none_of(cluster.triplets.begin(), cluster.triplets.end(), holds))
    {
      loose.push_back(image);
    }
  }
  for (std::size_t i = 0; i < loose.size() && others.size() >= 2; i += 2)
  {
    const std::string& any = others[others[0] == loose[i] ? 1 : 0];
    cluster.triplets.push_back(
      { loose[i], cluster.reference, i + 1 < loose.size() ? loose[i + 1] : any });
  }
}

// The cluster of what is left, without triplets when that is too little. Whole triplets stay as they are.
Cluster Remaining(
  const Cluster& cluster, const std::set<std::string>& names, std::set<std::string>& references)
{
  std::vector<std::string> others = OtherImages(cluster);
  const auto isGone = [&names](const std::string& image) { return names.count(image) > 0; };
  others.erase(std::remove_if(others.begin(), others.end(), isGone), others.end());
  Cluster left;
  left.name = cluster.name;
  left.reference = cluster.reference;
  if (isGone(cluster.reference))
  {
    const auto heir = std::find_if(others.begin(), others.end(),
      [&references](const std::string& image) { return references.insert(image).second; });
    if (heir == others.end())
    {
      return left;
    }
    left.reference = *heir;
    others.erase(heir);
  }
  else
  {
    for (const auto& triplet : cluster.triplets)
    {
      if (!isGone(triplet[0]) && !isGone(triplet[2]))
      {
        left.triplets.push_back(triplet);
      }
    }
  }
  AddTriplets(others, left);
  return left;
}

}

SparseModel WithoutImages(SparseModel model, const std::set<std::string>& names)
{
  const auto isGone = [&names](const SparseImage& image) { return names.count(image.name) > 0; };
  model.images.erase(
    std::remove_if(model.images.begin(), model.images.end(), isGone), model.images.end());
  return model;
}

Scene WithoutImages(Scene scene, const std::set<std::string>& names)
{
  const auto isNamed = [&names](const std::string& image) { return names.count(image) > 0; };
  std::set<std::string> references;
  for (const Cluster& cluster : scene.clusters)
  {
    references.insert(cluster.reference);
  }
  std::vector<Cluster> clusters;
  for (Cluster& cluster : scene.clusters)
  {
    bool isWhole = true;
    for (const auto& triplet : cluster.triplets)
    {
      isWhole = isWhole && std::none_of(triplet.begin(), triplet.end(), isNamed);
    }
    Cluster left = isWhole ? std::move(cluster) : Remaining(cluster, names, references);
    if (!left.triplets.empty())
    {
      clusters.push_back(std::move(left));
    }
  }
  scene.clusters = std::move(clusters);
  return scene;
}

}
