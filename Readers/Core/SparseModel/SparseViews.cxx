// SPDX-License-Identifier: BSD-3-Clause
#include "SparseModel/SparseViews.h"

#include "Common/Error.h"
#include "Common/Median.h"
#include "Images/LensDistortion.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace freespace
{

namespace
{

// A link whose point its camera can have seen.
bool IsInFront(const CalibratedImage& image, const Eigen::Vector3d& point)
{
  const double depth = image.camera.Depth(point);
  return depth > 1e-12 * (point - image.camera.Center()).norm() && std::isfinite(1 / depth);
}

// The greatest angle between two rays to the point, but for a factor near 1: that between the ray
// farthest from the first and the one farthest from it. Tracks may be as long as there are images.
double GreatestAngle(const std::vector<Eigen::Vector3d>& rays)
{
  const auto farthest = [&](const Eigen::Vector3d& from)
  {
    return *std::min_element(rays.begin(), rays.end(),
      [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b)
      { return a.dot(from) < b.dot(from); });
  };
  if (rays.empty())
  {
    return 0;
  }
  const Eigen::Vector3d one = farthest(rays.front());
  const Eigen::Vector3d other = farthest(one);
  return std::atan2(one.cross(other).norm(), one.dot(other));
}

int FeaturesInImage(const View& view)
{
  return static_cast<int>(std::count_if(view.points.begin(), view.points.end(),
    [&](const Eigen::Vector3d& point) { return view.camera.Sees(view.camera.Project(point)); }));
}

class ViewMaker
{
public:
  ViewMaker(
    const SparseModel& model, const SparseViewOptions& options, const ParallelFor& parallelFor)
    : Model(model)
    , Options(options)
    , Images(CalibratedImages(model))
    , Tracks(model)
    , Usable(model.points.size(), 0)
  {
    std::vector<double> angles(model.points.size());
    parallelFor(angles.size(),
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          angles[i] = this->AngleOf(i);
        }
      });
    const double least = this->LeastAngle(angles);
    for (std::size_t i = 0; i < angles.size(); ++i)
    {
      this->Usable[i] = angles[i] >= least;
    }
  }

  SparseView MakeView(std::size_t image) const
  {
    const CalibratedImage& calibrated = this->Images[image];
    const std::vector<SparseObservation>& observations = this->Model.images[image].observations;
    SparseView view;
    view.name = view.imageFile = calibrated.file;
    view.camera = calibrated.camera;
    view.image = static_cast<int>(image);
    std::vector<Eigen::Vector2d> pixels;
    for (std::size_t i = 0; i < observations.size(); ++i)
    {
      const int point = this->Tracks.pointOf[image][i];
      if (point >= 0 && this->Usable[static_cast<std::size_t>(point)] &&
        observations[i].pixel.allFinite() &&
        IsInFront(calibrated, this->Position(static_cast<std::size_t>(point))))
      {
        view.point.push_back(point);
        view.observation.push_back(static_cast<int>(i));
        pixels.push_back(observations[i].pixel);
      }
    }
    this->AddFeatures(UndistortPixels(calibrated, pixels), view);
    return view;
  }

private:
  // The one asked for, or the median where that is less.
  double LeastAngle(const std::vector<double>& angles) const
  {
    std::vector<double> known;
    std::copy_if(angles.begin(), angles.end(), std::back_inserter(known),
      [](double angle) { return angle >= 0; });
    if (known.empty())
    {
      return 0;
    }
    return std::min(Median(std::move(known)), this->Options.minimumAngle * M_PI / 180);
  }

  const Eigen::Vector3d& Position(std::size_t point) const
  {
    return this->Model.points[point].position;
  }

  // -1 for a point that too few images see.
  double AngleOf(std::size_t point) const
  {
    std::vector<Eigen::Vector3d> rays;
    int last = -1, images = 0;
    for (const SparseLink& link : this->Tracks.ofPoint[point])
    {
      const CalibratedImage& image = this->Images[static_cast<std::size_t>(link.image)];
      if (IsInFront(image, this->Position(point)))
      {
        images += link.image != last;
        last = link.image;
        rays.push_back((this->Position(point) - image.camera.Center()).normalized());
      }
    }
    return images >= this->Options.minimumTrackLength ? GreatestAngle(rays) : -1;
  }

  // Those whose projection is near enough. Pixels near the image are about as large with and
  // without distortion, so that the error may be taken of the undistorted ones.
  void AddFeatures(const std::vector<Eigen::Vector2d>& pixels, SparseView& view) const
  {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i)
    {
      const Eigen::Vector3d& position = this->Position(static_cast<std::size_t>(view.point[i]));
      const double error = (view.camera.Project(position) - pixels[i]).norm();
      if (error <= this->Options.maximumError)
      {
        view.points.push_back(position);
        view.imagePoints.push_back(pixels[i]);
        view.point[kept] = view.point[i];
        view.observation[kept] = view.observation[i];
        ++kept;
      }
    }
    view.point.resize(kept);
    view.observation.resize(kept);
  }

  const SparseModel& Model;
  SparseViewOptions Options;
  std::vector<CalibratedImage> Images;
  SparseTracks Tracks;
  std::vector<char> Usable; // per point
};

}

void SparseViewOptions::Check() const
{
  if (this->minimumTrackLength < 1 || this->minimumFeatures < 0)
  {
    throw Error("The least track length must be positive and the least number of features of an "
                "image cannot be negative.");
  }
  if (!(this->maximumError > 0) || !(this->minimumAngle >= 0 && this->minimumAngle < 90))
  {
    throw Error("The largest reprojection error must be positive and the least triangulation angle "
                "at least 0 and below 90 degrees.");
  }
}

std::vector<SparseView> ViewsFromModel(
  const SparseModel& model, const SparseViewOptions& options, const ParallelFor& parallelFor)
{
  options.Check();
  const ViewMaker maker(model, options, parallelFor);
  std::vector<SparseView> views(model.images.size());
  parallelFor(views.size(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        views[i] = maker.MakeView(i);
      }
    });
  views.erase(
    std::remove_if(views.begin(), views.end(),
      [&](const SparseView& view) { return FeaturesInImage(view) < options.minimumFeatures; }),
    views.end());
  return views;
}

}
