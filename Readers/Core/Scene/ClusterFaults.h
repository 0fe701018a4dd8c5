// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ClusterFaults_h
#define freespace_ClusterFaults_h

#include "Scene/Scene.h"

#include <array>
#include <set>
#include <string>

namespace freespace
{

/// What is wrong with a triplet of a cluster, for a message: the reference is not in its middle, or an image is in it
/// twice. Empty: nothing.
inline std::string TripletFault(
  const std::array<std::string, 3>& triplet, const std::string& reference)
{
  const auto& [one, middle, other] = triplet;
  const std::string all = "the triplet " + one + ", " + middle + ", " + other;
  if (middle != reference)
  {
    return all + " does not have the reference " + reference + " in its middle";
  }
  return one == middle || middle == other || other == one ? all + " has an image twice" : "";
}

/// The same for a cluster among others, to whose names it adds its own: it has no triplet, or one of their names.
inline std::string ClusterFault(const Cluster& cluster, std::set<std::string>& names)
{
  if (cluster.triplets.empty())
  {
    return "the cluster " + cluster.name + " has no triplet";
  }
  return names.insert(cluster.name).second ? "" : "two clusters are called " + cluster.name;
}

}

#endif
