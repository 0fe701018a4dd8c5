// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/CameraRefinement.h"

#include "Common/Error.h"
#include "Common/ParallelForWithProgress.h"
#include "Refinement/RefinementClusters.h"
#include "Refinement/TrackBytes.h"
#include "Sharing/MakeAll.h"

#include <map>
#include <utility>

namespace freespace
{

namespace
{

// The index of each image's camera in the model, so that images of one lens share it.
std::vector<int> LensesOf(const SparseModel& model)
{
  std::map<std::uint32_t, int> indices;
  std::vector<int> lenses;
  for (const SparseImage& image : model.images)
  {
    const auto added = indices.emplace(image.camera, static_cast<int>(indices.size()));
    lenses.push_back(added.first->second);
  }
  return lenses;
}

std::vector<EdgeTrack> MatchAll(EdgeStore& edges, const std::vector<CalibratedImage>& images,
  const std::vector<Cluster>& clusters, const MatcherOptions& matching,
  const CameraRefinementOptions& options, const ClusterTracks& known,
  const ParallelFor& parallelFor, const Progress& progress)
{
  using Tracks = std::vector<EdgeTrack>;
  const auto isKnown = [&](const Cluster& cluster) { return known.count(cluster.triplets) > 0; };
  std::vector<const Cluster*> unknown;
  for (const Cluster& cluster : clusters)
  {
    if (!isKnown(cluster))
    {
      unknown.push_back(&cluster);
    }
  }
  std::vector<Tracks> matched = MakeAll<Tracks>(unknown.size(), parallelFor, progress,
    [&](std::size_t i, const CancellationFlag& stop)
    {
      const ClusterMatches matches =
        MatchCluster(edges, images, *unknown[i], matching, options.matching.tokensPerImage, stop);
      return TracksOfCluster(matches, options.matching.TracksOfEach(images.size()));
    });
  auto next = matched.begin();
  std::vector<EdgeTrack> tracks;
  for (const Cluster& cluster : clusters)
  {
    const Tracks& some = isKnown(cluster) ? known.at(cluster.triplets) : *next++;
    tracks.insert(tracks.end(), some.begin(), some.end());
  }
  return tracks;
}

std::vector<Camera> CamerasOf(const std::vector<CalibratedImage>& images)
{
  std::vector<Camera> cameras;
  for (const CalibratedImage& image : images)
  {
    cameras.push_back(image.camera);
  }
  return cameras;
}

BundleAdjustmentSummary Adjust(const std::vector<CalibratedImage>& given,
  std::vector<CalibratedImage>& images, const std::vector<int>& lenses,
  std::vector<EdgeTrack>& tracks, const BundleAdjustmentOptions& options)
{
  std::vector<Camera> cameras = CamerasOf(images);
  const BundleAdjustmentSummary summary =
    AdjustCameras(CamerasOf(given), cameras, lenses, tracks, options);
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    images[i].camera = cameras[i];
  }
  return summary;
}

}

void CameraRefinementOptions::Check() const
{
  this->adjustment.Check();
  this->matching.Check();
  if (this->rounds < 1)
  {
    throw Error("Refining cameras takes one round at least.");
  }
  if (!(this->leastMotion >= 0))
  {
    throw Error("The least motion of camera refinement must not be negative.");
  }
}

CameraRefinement RefineCameras(const Scene& scene, const SparseModel& model, EdgeStore& edges,
  const MatcherOptions& matching, const CameraRefinementOptions& options,
  const ParallelFor& parallelFor, const Progress& progress, const ClusterTracks& known)
{
  options.Check();
  const std::vector<CalibratedImage> given = CalibratedImages(model);
  const std::vector<int> lenses = LensesOf(model);
  const std::vector<Cluster> clusters =
    ClustersForRefinement(scene, model, options.matching.neighbors);
  CameraRefinement result;
  result.images = given;
  result.clusters = clusters.size();
  MatcherOptions round = matching;
  round.tolerance = options.matching.tolerance;
  for (int k = 0; k < options.rounds && !clusters.empty(); ++k, round.tolerance /= 2)
  {
    const double begin = double(k) / options.rounds, end = double(k + 1) / options.rounds;
    std::vector<EdgeTrack> tracks =
      MatchAll(edges, result.images, clusters, round, options, k == 0 ? known : ClusterTracks(),
        parallelFor, progress.Part(begin, begin + 0.6 * (end - begin)));
    result.tracks = tracks.size();
    BundleAdjustmentSummary summary;
    RunWithProgress(progress.Part(begin + 0.6 * (end - begin), end),
      [&](const CancellationFlag&)
      { summary = Adjust(given, result.images, lenses, tracks, options.adjustment); });
    result.residuals.residualAfter = summary.residualAfter;
    result.residuals.motion = summary.motion;
    if (k == 0)
    {
      result.residuals.residualBefore = summary.residualBefore;
      if (!(summary.motion > options.leastMotion))
      {
        result.images = given;
        return result;
      }
    }
    progress(end);
  }
  result.isRefined = !clusters.empty();
  return result;
}

SparseModel WithCameras(SparseModel model, const std::vector<CalibratedImage>& images)
{
  std::map<std::uint32_t, SparseCamera*> cameras;
  for (SparseCamera& camera : model.cameras)
  {
    cameras[camera.id] = &camera;
  }
  for (std::size_t i = 0; i < model.images.size(); ++i)
  {
    const Camera& camera = images[i].camera;
    const Eigen::Quaterniond q(camera.R);
    model.images[i].rotation = { q.w(), q.x(), q.y(), q.z() };
    model.images[i].matrix.reset();
    model.images[i].translation = camera.t;
    SparseCamera& lens = *cameras.at(model.images[i].camera);
    lens.parameters[0] = camera.K(0, 0);
    lens.parameters[FocalLengths(lens.model) - 1] =
      FocalLengths(lens.model) == 1 ? camera.K(0, 0) : camera.K(1, 1);
  }
  return model;
}

}
