// SPDX-License-Identifier: BSD-3-Clause
#include "Stereo/EdgeStereo.h"

#include "Common/Error.h"
#include "Patches/PatchStereo.h"
#include "Stereo/ClusterMatching.h"

#include <limits>

namespace freespace
{

namespace
{

// Slope of the points along a chain, over `radius` neighbours to either side.
Eigen::Vector3d DirectionAlong(
  const std::vector<Eigen::Vector3d>& points, const std::vector<int>& chain, int k, int radius)
{
  const int begin = std::max(0, k - radius);
  const int end = std::min(static_cast<int>(chain.size()) - 1, k + radius);
  const double middle = 0.5 * (begin + end);
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
  for (int j = begin; j <= end; ++j)
  {
    slope += (j - middle) * points[chain[j]];
  }
  return slope.normalized();
}

void AddFeature(const EdgeToken& token, const EdgeMatch& match, EdgeView& view)
{
  view.points.push_back(view.camera.Unproject(match.imagePoint, 1 / match.disparity));
  view.imagePoints.push_back(match.imagePoint);
  view.colors.push_back({ token.color[2], token.color[1], token.color[0] });
  view.matchingCosts.push_back(match.cost);
  view.deviations.push_back(match.deviation);
}

// Turns matches into features and runs into chains.
void FillView(const EdgeChains& edges, const LargeVector<EdgeMatch>& matches, EdgeView& view)
{
  int run = -1;
  for (std::size_t i = 0; i < matches.size(); ++i)
  {
    if (matches[i].images == 0 || !view.camera.Sees(matches[i].imagePoint))
    {
      continue;
    }
    if (matches[i].run != run)
    {
      run = matches[i].run;
      view.chains.emplace_back();
    }
    view.chains.back().push_back(static_cast<int>(view.points.size()));
    view.chainIds.push_back(static_cast<int>(view.chains.size()) - 1);
    AddFeature(edges.tokens[i], matches[i], view);
  }
  view.edgeDirections.resize(view.points.size());
  for (const std::vector<int>& chain : view.chains)
  {
    for (int k = 0; k < static_cast<int>(chain.size()); ++k)
    {
      view.edgeDirections[chain[k]] = DirectionAlong(view.points, chain, k, 4);
    }
  }
}

// Where edges have no match: every so many tokens.
std::vector<Eigen::Vector2d> OpenEdges(
  const EdgeChains& edges, const LargeVector<EdgeMatch>& matches, int step)
{
  std::vector<Eigen::Vector2d> places;
  for (std::size_t chain = 0; chain < edges.NumberOfChains(); ++chain)
  {
    for (int i = edges.begin[chain]; i < edges.begin[chain + 1]; i += step)
    {
      if (matches[i].images == 0)
      {
        places.push_back(edges.tokens[i].position);
      }
    }
  }
  return places;
}

void AddPatches(const std::vector<PatchFeature>& patches, EdgeView& view)
{
  for (const PatchFeature& patch : patches)
  {
    view.points.push_back(view.camera.Unproject(patch.imagePoint, 1 / patch.disparity));
    view.imagePoints.push_back(patch.imagePoint);
    view.colors.push_back(patch.color);
    view.matchingCosts.push_back(patch.cost);
    view.deviations.push_back(patch.deviation);
    view.edgeDirections.push_back(Eigen::Vector3d::Zero());
    view.chainIds.push_back(-1);
  }
}

}

void EdgeStereoOptions::Check() const
{
  this->edges.Check();
  this->matching.Check();
  this->patches.Check();
}

EdgeView FindFeatures(EdgeStore& edges, ImagePyramids& photographs,
  const std::vector<CalibratedImage>& images, const Cluster& cluster,
  const EdgeStereoOptions& options, const CancellationFlag& stop)
{
  const ClusterMatches found = MatchCluster(
    edges, images, cluster, options.matching, std::numeric_limits<std::size_t>::max(), stop);
  EdgeView view;
  view.name = cluster.name;
  view.imageFile = cluster.reference;
  view.camera = found.reference.camera;
  view.tokens = found.reference.edges.tokens.size();
  FillView(found.reference.edges, found.matches, view);
  if (view.points.size() < 3)
  {
    throw TooFewFeatures("Cluster '" + cluster.name +
      "' has fewer than three features in its reference image " + cluster.reference + ".");
  }
  if (options.patches.isOn)
  {
    std::vector<CalibratedImage> partners;
    for (const int other : found.otherImages)
    {
      partners.push_back(images[other]);
    }
    const auto seeds = OpenEdges(found.reference.edges, found.matches, options.patches.seedStep);
    AddPatches(FindPatches(view, seeds, images[found.referenceImage], partners, photographs,
                 options.patches, stop),
      view);
  }
  return view;
}

EdgeView FindFeatures(const Scene& scene, const std::vector<CalibratedImage>& images,
  const Cluster& cluster, const EdgeStereoOptions& options, const CancellationFlag& stop)
{
  options.Check();
  EdgeStore edges(scene, options.edges);
  ImagePyramids photographs(scene);
  return FindFeatures(edges, photographs, images, cluster, options, stop);
}

}
