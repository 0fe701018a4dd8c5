// SPDX-License-Identifier: BSD-3-Clause
#include "Summary/ModelSummary.h"

#include "Common/Median.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

namespace
{

constexpr std::size_t MostRays = 20;

double GreatestAngle(const Eigen::Vector3d& point, const std::vector<SparseLink>& track,
  const std::vector<CalibratedImage>& images)
{
  constexpr double degrees = 180 / 3.14159265358979323846;
  const std::size_t count = std::min(track.size(), MostRays);
  std::vector<Eigen::Vector3d> rays;
  for (std::size_t i = 0; i < count; ++i)
  {
    const SparseLink& link = track[i * track.size() / count];
    rays.push_back(images[link.image].camera.Center() - point);
  }
  double greatest = 0;
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    for (std::size_t k = 0; k < i; ++k)
    {
      greatest =
        std::max(greatest, std::atan2(rays[i].cross(rays[k]).norm(), rays[i].dot(rays[k])));
    }
  }
  return degrees * greatest;
}

}

Spread SpreadOf(std::vector<double> values)
{
  values.erase(std::remove_if(
                 values.begin(), values.end(), [](double value) { return !std::isfinite(value); }),
    values.end());
  if (values.empty())
  {
    return {};
  }
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  return { values.size(), *least, Median(values), *greatest };
}

ModelSummary Summarize(const SparseModel& model)
{
  ModelSummary summary;
  summary.cameras = model.cameras.size();
  summary.images = model.images.size();
  summary.points = model.points.size();
  const std::vector<CalibratedImage> images = CalibratedImages(model);
  for (const CalibratedImage& image : images)
  {
    summary.centers.extend(image.camera.Center());
  }
  const SparseTracks tracks(model);
  std::vector<double> lengths, angles, errors;
  for (std::size_t i = 0; i < model.points.size(); ++i)
  {
    const SparsePoint& point = model.points[i];
    const auto& track = tracks.ofPoint[i];
    summary.bounds.extend(point.position);
    summary.observations += track.size();
    if (!track.empty())
    {
      lengths.push_back(static_cast<double>(track.size()));
    }
    if (track.size() > 1)
    {
      angles.push_back(GreatestAngle(point.position, track, images));
    }
    if (point.error >= 0)
    {
      errors.push_back(point.error);
    }
  }
  summary.trackLengths = SpreadOf(std::move(lengths));
  summary.angles = SpreadOf(std::move(angles));
  summary.errors = SpreadOf(std::move(errors));
  return summary;
}

}
