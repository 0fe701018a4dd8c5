// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_EdgeTracks_h
#define freespace_EdgeTracks_h

#include "Stereo/ClusterMatching.h"

#include <Eigen/Dense>

#include <map>
#include <vector>

namespace freespace
{

/// The observation of a point of an edge: it lies on the line through `position` along the edge.
struct EdgeObservation
{
  int image = 0;                                      ///< index of the camera
  Eigen::Vector2d position = Eigen::Vector2d::Zero(); ///< pixels, without lens distortion
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();  ///< across the edge, unit length
  double uncertainty = 1; ///< of the position across the edge, in that of a strong edge; > 0
};

/// One point of an edge in space and its images, the reference first. The reference selects the
/// point of the edge, the others constrain it only across the edge.
struct EdgeTrack
{
  Eigen::Vector3d point = Eigen::Vector3d::Zero(); ///< world
  std::vector<EdgeObservation> observations;
};

/// The tracks of clusters, by their images.
using ClusterTracks = std::map<decltype(Cluster::triplets), std::vector<EdgeTrack>>;

/// Tracks of a cluster's matches that a third image confirms, about `most` of them, evenly chosen.
std::vector<EdgeTrack> TracksOfCluster(const ClusterMatches& cluster, std::size_t most);

}

#endif
