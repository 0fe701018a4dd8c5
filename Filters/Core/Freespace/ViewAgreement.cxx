// SPDX-License-Identifier: BSD-3-Clause
#include "Freespace/ViewAgreement.h"

#include "Common/ParallelForWithProgress.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

// Maximum number of evaluations of a view in all.
constexpr std::size_t Questions = 4000000;
constexpr std::size_t MostOfView = 4000;

struct Counts
{
  std::vector<std::size_t> eroded, blocked; // by the number of views, from 1
  std::size_t places = 0;
};

}

std::vector<AgreementErrors> ErrorsOfAgreement(
  const std::vector<std::unique_ptr<ViewFreespace>>& views,
  const std::vector<ViewFeatures>& features, const Eigen::AlignedBox3d& box, double spacings,
  int most, const ParallelFor& parallelFor, const Progress& progress)
{
  const std::size_t count = features.size();
  std::vector<Counts> ofViews(count);
  const std::size_t perView =
    std::clamp<std::size_t>(Questions / std::max<std::size_t>(1, count * count), 20, MostOfView);
  ParallelForWithProgress(count, parallelFor, progress,
    [&](std::size_t own, const CancellationFlag& stop)
    {
      const ViewFeatures& view = features[own];
      Counts& counts = ofViews[own];
      counts.eroded.assign(most, 0);
      counts.blocked.assign(most, 0);
      const double focal = std::sqrt(std::abs(view.camera.K(0, 0) * view.camera.K(1, 1)));
      const double little = spacings * std::max(view.spacing, 1.0) / focal; // of the depth
      const std::size_t asked = std::min(perView, view.points.size());
      for (std::size_t i = 0; i < asked; ++i)
      {
        ThrowIfCancelled(stop);
        const Vector3d& point = view.points[i * view.points.size() / asked];
        if (!box.contains(point))
        {
          continue;
        }
        const Vector3d step = little * (point - view.camera.Center());
        int before = 1, behind = 0; // its own view sees the place before it
        for (std::size_t other = 0; other < count; ++other)
        {
          before += other != own && views[other]->IsFree(point - step);
          behind += other != own && views[other]->IsFree(point + step);
        }
        ++counts.places;
        for (int k = 1; k <= most; ++k)
        {
          counts.eroded[k - 1] += behind >= k;
          counts.blocked[k - 1] += before < k;
        }
      }
    });
  std::vector<AgreementErrors> errors(most);
  std::size_t places = 0;
  for (const Counts& counts : ofViews)
  {
    places += counts.places;
  }
  for (int k = 0; k < most && places > 0; ++k)
  {
    for (const Counts& counts : ofViews)
    {
      errors[k].eroded += static_cast<double>(counts.eroded[k]) / places;
      errors[k].blocked += static_cast<double>(counts.blocked[k]) / places;
    }
  }
  return errors;
}

int ViewsThatMustAgree(const std::vector<AgreementErrors>& errors)
{
  constexpr double hardlyAny = 0.001;
  return errors.size() > 1 && (errors[1].Sum() < errors[0].Sum() || errors[1].blocked <= hardlyAny)
    ? 2
    : 1;
}

}
