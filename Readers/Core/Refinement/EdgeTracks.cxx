// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/EdgeTracks.h"

#include <algorithm>

namespace freespace
{

namespace
{

EdgeObservation ObservationOf(const EdgeToken& token, int image)
{
  return { image, token.position, token.Normal(), token.Uncertainty() };
}

}

std::vector<EdgeTrack> TracksOfCluster(const ClusterMatches& cluster, std::size_t most)
{
  const auto isConfirmed = [](const EdgeMatch& match) { return match.images >= 2; };
  const std::size_t confirmed =
    std::count_if(cluster.matches.begin(), cluster.matches.end(), isConfirmed);
  const std::size_t stride = std::max<std::size_t>(1, confirmed / std::max<std::size_t>(most, 1));
  std::vector<EdgeTrack> tracks;
  std::size_t number = 0; // of the confirmed match
  for (std::size_t i = 0; i < cluster.matches.size(); ++i)
  {
    const EdgeMatch& match = cluster.matches[i];
    if (!isConfirmed(match) || number++ % stride != 0)
    {
      continue;
    }
    EdgeTrack& track = tracks.emplace_back();
    track.point = cluster.reference.camera.Unproject(match.imagePoint, 1 / match.disparity);
    track.observations.push_back(
      ObservationOf(cluster.reference.edges.tokens[i], cluster.referenceImage));
    for (int k = match.support; k < match.support + match.images; ++k)
    {
      const EdgeCandidate& other = cluster.support[k];
      track.observations.push_back(ObservationOf(
        cluster.others[other.image].edges.tokens[other.token], cluster.otherImages[other.image]));
    }
  }
  return tracks;
}

}
