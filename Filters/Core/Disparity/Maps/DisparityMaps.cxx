// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/Maps/DisparityMaps.h"

#include "Common/ParallelForWithProgress.h"
#include "Disparity/FeatureCloud.h"
#include "Disparity/Outliers/Outliers.h"

#include <optional>
#include <utility>

namespace freespace
{

void DisparityMapOptions::Check() const
{
  this->thinning.Check();
  this->outliers.Check();
  this->disparity.Check();
  this->background.Check();
  this->trim.Check();
}

void MakeDisparityMaps(std::vector<View> views, const DisparityMapOptions& options,
  const ParallelFor& parallelFor, const Progress& progress,
  const std::function<void(std::size_t, DisparityMap)>& take)
{
  options.Check();
  ParallelForWithProgress(views.size(), parallelFor, progress.Part(0.0, 0.02),
    [&](std::size_t v, const CancellationFlag&)
    { views[v] = ThinFeatures(views[v], options.thinning); });
  if (options.outliers.IsOn())
  {
    views = RejectOutliers(
      views, options.outliers, options.disparity, parallelFor, progress.Part(0.02, 0.25));
  }
  std::optional<FeatureCloud> cloud;
  RunWithProgress(
    progress.Part(0.25, 0.3), [&](const CancellationFlag& stop) { cloud.emplace(views, stop); });
  std::vector<DisparityMap> maps =
    TriangulateViews(views, *cloud, options.disparity, parallelFor, progress.Part(0.3, 0.65));
  views.clear();
  if (options.continueBackground)
  {
    ContinueBackground(maps, *cloud, options.background, parallelFor, progress.Part(0.65, 0.95));
  }
  ParallelForWithProgress(maps.size(), parallelFor, progress.Part(0.95, 1.0),
    [&](std::size_t i, const CancellationFlag&)
    {
      TrimTriangles(maps[i], options.trim);
      take(i, std::move(maps[i]));
    });
}

}
