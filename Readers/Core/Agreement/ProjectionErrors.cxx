// SPDX-License-Identifier: BSD-3-Clause
#include "Agreement/ProjectionErrors.h"

#include "Common/Median.h"
#include "Images/LensDistortion.h"

#include <algorithm>
#include <cstdio>
#include <limits>

namespace freespace
{

namespace
{

constexpr std::size_t Few = 10;     // too few observations to judge
constexpr double TimesTheUsual = 5; // and farther: no longer the error of a sloppy calibration

// Of the observations of points; a point behind the camera is as far off as can be. -1: too few.
double MedianError(const CalibratedImage& image, const SparseImage& source,
  const std::vector<int>& pointOf, const std::vector<SparsePoint>& points)
{
  std::vector<Eigen::Vector2d> pixels;
  std::vector<Eigen::Vector3d> positions;
  for (std::size_t i = 0; i < pointOf.size(); ++i)
  {
    if (pointOf[i] >= 0 && source.observations[i].pixel.allFinite())
    {
      pixels.push_back(source.observations[i].pixel);
      positions.push_back(points[static_cast<std::size_t>(pointOf[i])].position);
    }
  }
  if (pixels.size() < Few)
  {
    return -1;
  }
  pixels = UndistortPixels(image, pixels);
  std::vector<double> errors;
  for (std::size_t i = 0; i < pixels.size(); ++i)
  {
    if (pixels[i].allFinite()) // a fisheye lens sees more than a pinhole camera
    {
      errors.push_back(image.camera.Depth(positions[i]) > 0
          ? (image.camera.Project(positions[i]) - pixels[i]).norm()
          : std::numeric_limits<double>::infinity());
    }
  }
  return errors.size() < Few ? -1 : Median(std::move(errors));
}

}

std::vector<MisprojectedImage> FindMisprojectedImages(const SparseModel& model, double least)
{
  const std::vector<CalibratedImage> images = CalibratedImages(model);
  const SparseTracks tracks(model);
  std::vector<double> errors, known;
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    errors.push_back(MedianError(images[i], model.images[i], tracks.pointOf[i], model.points));
    if (errors.back() >= 0)
    {
      known.push_back(errors.back());
    }
  }
  std::vector<MisprojectedImage> wrong;
  if (known.empty())
  {
    return wrong;
  }
  const double most = std::max(least, TimesTheUsual * Median(std::move(known)));
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    if (errors[i] > most)
    {
      wrong.push_back({ images[i].file, errors[i] });
    }
  }
  return wrong;
}

std::set<std::string> NamesOf(const std::vector<MisprojectedImage>& images)
{
  std::set<std::string> names;
  for (const MisprojectedImage& image : images)
  {
    names.insert(image.name);
  }
  return names;
}

std::string DescribeMisprojected(const std::vector<MisprojectedImage>& images, std::size_t all)
{
  std::string text;
  for (const MisprojectedImage& image : images)
  {
    char pixels[40];
    std::snprintf(pixels, sizeof(pixels), " (%.3g pixels)", image.error);
    text += (text.empty() ? "" : ", ") + image.name + pixels;
  }
  return std::to_string(images.size()) + " of " + std::to_string(all) +
    (images.size() == 1 ? " images is" : " images are") +
    " left out: their observations are not the projections of their points, the camera is wrong: " +
    text;
}

}
