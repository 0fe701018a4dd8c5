// SPDX-License-Identifier: BSD-3-Clause
#include "Agreement/SceneFeatures.h"

#include "Common/Median.h"
#include "Sharing/MakeAll.h"
#include "Sharing/ViewBytes.h"

#include <algorithm>

namespace freespace
{

namespace
{

// Of the edge pixels, those that are features. Patches do not count: they may agree by chance.
double Share(const EdgeView& view)
{
  const auto matched =
    std::count_if(view.chainIds.begin(), view.chainIds.end(), [](int chain) { return chain >= 0; });
  return static_cast<double>(matched) / static_cast<double>(std::max<std::size_t>(view.tokens, 1));
}

// The view of a cluster, or one without features.
EdgeView FeaturesOf(EdgeStore& edges, ImagePyramids& photographs,
  const std::vector<CalibratedImage>& images, const Cluster& cluster, bool isNeeded,
  const EdgeStereoOptions& options, const CancellationFlag& stop)
{
  EdgeView nothing;
  nothing.name = cluster.name;
  nothing.imageFile = cluster.reference;
  try
  {
    return FindFeatures(edges, photographs, images, cluster, options, stop);
  }
  catch (const Aborted&)
  {
    throw;
  }
  catch (const TooFewFeatures&)
  {
    return nothing;
  }
  catch (const Error&)
  {
    if (isNeeded)
    {
      throw;
    }
    return nothing;
  }
}

std::string Describe(const EdgeView& view)
{
  const std::string count = view.points.size() < 3 ? "fewer than three features"
                                                   : std::to_string(view.points.size()) +
      " features of " + std::to_string(view.tokens) + " edge pixels";
  return view.name + " (" + count + ")";
}

}

std::vector<char> FindPoorViews(const std::vector<EdgeView>& views)
{
  constexpr double least = 1.0 / 15; // of the usual share
  constexpr std::size_t several = 4;
  std::vector<double> shares;
  for (const EdgeView& view : views)
  {
    if (view.points.size() >= 3)
    {
      shares.push_back(Share(view));
    }
  }
  const double usual = shares.size() >= several ? Median(std::move(shares)) : 0;
  std::vector<char> isPoor;
  for (const EdgeView& view : views)
  {
    isPoor.push_back(view.points.size() < 3 || Share(view) < least * usual);
  }
  return isPoor;
}

std::vector<EdgeView> FindSceneFeatures(const Scene& scene,
  const std::vector<CalibratedImage>& images, EdgeStore& edges, std::size_t needed,
  const EdgeStereoOptions& options, const ParallelFor& parallelFor, const Progress& progress,
  std::vector<std::string>& warnings)
{
  ImagePyramids photographs(scene);
  std::vector<EdgeView> views = MakeAll<EdgeView>(scene.clusters.size(), parallelFor, progress,
    [&](std::size_t i, const CancellationFlag& stop) {
      return FeaturesOf(edges, photographs, images, scene.clusters[i], i < needed, options, stop);
    });
  const std::vector<char> isPoor = FindPoorViews(views);
  std::vector<EdgeView> good;
  std::string poor;
  std::size_t count = 0;
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    if (!isPoor[i])
    {
      good.push_back(std::move(views[i]));
    }
    else if (i < needed || views[i].points.size() >= 3)
    {
      poor += (poor.empty() ? "" : ", ") + Describe(views[i]);
      ++count;
    }
  }
  if (good.empty() && !views.empty())
  {
    throw TooFewFeatures("Cluster '" + views[0].name +
      "' has fewer than three features in its reference image " + views[0].imageFile +
      (views.size() > 1 ? ", and no other cluster has more." : "."));
  }
  if (count > 0)
  {
    warnings.push_back(std::to_string(count) + " of " + std::to_string(views.size()) +
      (count == 1 ? " clusters is" : " clusters are") +
      " left out for want of features, the images do not fit each other: " + poor);
  }
  return good;
}

}
