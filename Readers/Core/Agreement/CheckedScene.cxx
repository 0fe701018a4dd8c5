// SPDX-License-Identifier: BSD-3-Clause
#include "Agreement/CheckedScene.h"

#include "Agreement/ProjectionErrors.h"
#include "Agreement/RemainingImages.h"
#include "Files/PathChecks.h"
#include "Common/Error.h"
#include "Scene/SceneClusters.h"

#include <filesystem>
#include <utility>

namespace freespace
{

namespace
{

std::string Joined(const std::vector<std::string>& names)
{
  std::string text;
  for (const std::string& name : names)
  {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

void LeaveOut(const std::set<std::string>& names, CheckedScene& checked)
{
  const bool hasClusters = !checked.given.clusters.empty();
  checked.given = WithoutImages(std::move(checked.given), names);
  checked.model = WithoutImages(std::move(checked.model), names);
  if (hasClusters && checked.given.clusters.empty())
  {
    throw Error("No cluster of the scene " + checked.given.file +
      " has three images that do not contradict each other. " + Joined(checked.warnings));
  }
}

// Reports images without a mask where the scene has masks. Throws Error if none has one.
void CheckMasks(const Scene& scene, const SparseModel& model, std::vector<std::string>& warnings)
{
  std::vector<std::string> missing;
  std::size_t photographs = 0;
  for (const SparseImage& image : model.images)
  {
    if (!scene.masks.empty() && IsThere(scene.ImagePath(image.name)))
    {
      ++photographs;
      if (!IsThere(scene.MaskPath(image.name)))
      {
        missing.push_back(image.name);
      }
    }
  }
  if (missing.empty())
  {
    return;
  }
  if (missing.size() == photographs)
  {
    throw Error("No image of the scene " + scene.file + " has a mask: there is no " +
      scene.MaskPath(missing.front()) + ".");
  }
  warnings.push_back(std::to_string(missing.size()) + " of " + std::to_string(photographs) +
    " images have no mask and are used whole: " + Joined(missing));
}

}

CheckedScene CheckScene(const Scene& scene, SparseModel model, EdgeStore& edges,
  const MatcherOptions& matching, const ClusterProposalOptions& clusters, bool check,
  const ParallelFor& parallelFor, const Progress& progress)
{
  CheckedScene checked;
  checked.given = scene;
  checked.model = std::move(model);
  CheckMasks(scene, checked.model, checked.warnings);
  const std::size_t all = checked.model.images.size();
  const auto misprojected =
    check ? FindMisprojectedImages(checked.model) : std::vector<MisprojectedImage>();
  if (!misprojected.empty())
  {
    checked.warnings.push_back(DescribeMisprojected(misprojected, all));
    LeaveOut(NamesOf(misprojected), checked);
  }
  const auto wrong = check ? FindWrongImages(checked.given, checked.model, edges, matching,
                               WrongImageOptions(), parallelFor, progress, &checked.tracks)
                           : std::vector<std::string>();
  if (!wrong.empty())
  {
    checked.warnings.push_back(std::to_string(wrong.size()) + " of " + std::to_string(all) +
      (wrong.size() == 1 ? " images is" : " images are") +
      " left out: their edges contradict those of the others, the file is another image, it is "
      "rotated, or "
      "the camera is wrong: " +
      Joined(wrong));
    LeaveOut({ wrong.begin(), wrong.end() }, checked);
    checked.tracks.clear(); // their indices were those of all images
  }
  checked.scene = checked.given;
  if (checked.scene.clusters.empty())
  {
    checked.scene =
      WithProposedClusters(std::move(checked.scene), checked.model, clusters, &checked.choice);
  }
  return checked;
}

}
