// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/EveryImage.h"

#include <filesystem>
#include <set>

namespace freespace
{

namespace
{

using Triplet = std::array<std::string, 3>;

Cluster WithReference(const Cluster& cluster, const std::string& image)
{
  Cluster turned;
  turned.reference = image;
  for (const Triplet& triplet : cluster.triplets)
  {
    if (triplet[0] == image || triplet[2] == image)
    {
      turned.triplets.push_back(
        { cluster.reference, image, triplet[0] == image ? triplet[2] : triplet[0] });
    }
    else
    {
      turned.triplets.push_back({ triplet[0], image, triplet[2] });
    }
  }
  return turned;
}

}

std::vector<Cluster> ClustersOfEveryImage(const std::vector<Cluster>& clusters)
{
  std::set<std::string> references, names;
  for (const Cluster& cluster : clusters)
  {
    references.insert(cluster.reference);
    names.insert(cluster.name);
  }
  std::vector<Cluster> turned;
  for (const Cluster& cluster : clusters)
  {
    for (const Triplet& triplet : cluster.triplets)
    {
      for (const std::string& image : { triplet[0], triplet[2] })
      {
        if (references.insert(image).second)
        {
          turned.push_back(WithReference(cluster, image));
          const std::string name =
            cluster.name + "_" + std::filesystem::path(image).stem().string();
          std::string& unique = turned.back().name = name;
          for (int n = 2; !names.insert(unique).second; ++n)
          {
            unique = name + "_" + std::to_string(n);
          }
        }
      }
    }
  }
  return turned;
}

}
