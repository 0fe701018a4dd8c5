// SPDX-License-Identifier: BSD-3-Clause
#include "Patches/PatchStereo.h"

#include "Patches/DisparityPlanes.h"
#include "Patches/PatchAligner.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace freespace
{

using Eigen::Vector2d;

namespace
{

// Minimum distance of a grid point from features and seeds, in pixels along rows and columns.
constexpr int EmptyRadius = 3;

// Where a patch does not converge, one at half the resolution may: its range of convergence is twice as
// large, and it need not be as accurate.
constexpr double CoarseCorrelation = 0.6;
constexpr double CoarseDeviation = 4; // times that of a feature

// Points of a grid outside the mask that have no feature and no seed near them.
std::vector<Vector2d> EmptyPlaces(
  const View& view, const std::vector<Vector2d>& seeds, const cv::Mat1b& mask, int spacing)
{
  cv::Mat1b isTaken(view.camera.height, view.camera.width, uchar(0));
  for (const auto* points : { &view.imagePoints, &seeds })
  {
    for (const Vector2d& point : *points)
    {
      const int column = std::clamp(static_cast<int>(point.x()), 0, isTaken.cols - 1);
      const int row = std::clamp(static_cast<int>(point.y()), 0, isTaken.rows - 1);
      isTaken(row, column) = 1;
    }
  }
  const int side = 2 * EmptyRadius + 1;
  cv::dilate(isTaken, isTaken, cv::Mat::ones(side, side, CV_8U));
  std::vector<Vector2d> places;
  for (int row = spacing / 2; row < isTaken.rows; row += spacing)
  {
    for (int column = spacing / 2; column < isTaken.cols; column += spacing)
    {
      if (!isTaken(row, column) && (mask.empty() || mask(row, column) != 0))
      {
        places.emplace_back(column + 0.5, row + 0.5);
      }
    }
  }
  return places;
}

// Aligns at full resolution, and over half of it where that fails.
class CoarseToFine
{
public:
  CoarseToFine(const Camera& camera, const ImagePyramid& reference,
    const std::vector<CalibratedImage>& partners, ImagePyramids& images,
    const PatchOptions& options)
    : Fine(MakeAligner(camera, reference, partners, images, 0, options))
    , Coarse(MakeAligner(camera, reference, partners, images, 1, CoarseOptions(options)))
  {
  }

  AlignedPatch Align(const PatchPlane& initial) const
  {
    AlignedPatch fine = this->Fine.Align(initial);
    if (fine.isGood || !fine.isTextured)
    {
      return fine;
    }
    const AlignedPatch coarse = this->Coarse.Align(initial);
    return coarse.isGood ? this->Fine.Align(coarse.plane) : fine;
  }

  double Parallax(const PatchPlane& plane) const { return this->Fine.Parallax(plane); }

private:
  static PatchOptions CoarseOptions(PatchOptions options)
  {
    options.leastCorrelation = std::min(options.leastCorrelation, CoarseCorrelation);
    options.mostDeviation *= CoarseDeviation;
    return options;
  }

  static PatchAligner MakeAligner(const Camera& camera, const ImagePyramid& reference,
    const std::vector<CalibratedImage>& partners, ImagePyramids& images, int level,
    const PatchOptions& options)
  {
    std::vector<PatchAligner::Image> others;
    for (const CalibratedImage& partner : partners)
    {
      others.push_back({ partner.camera, images.Find(partner)->levels[level] });
    }
    return PatchAligner({ camera, reference.levels[level] }, others, level == 0 ? 1 : 0.5, options);
  }

  PatchAligner Fine, Coarse;
};

}

std::vector<PatchFeature> FindPatches(const View& view, const std::vector<Vector2d>& seeds,
  const CalibratedImage& reference, const std::vector<CalibratedImage>& partners,
  ImagePyramids& images, const PatchOptions& options, const CancellationFlag& stop)
{
  options.Check();
  const auto image = images.Find(reference);
  const CoarseToFine aligner(reference.camera, *image, partners, images, options);
  const DisparityPlanes planes(view);
  std::vector<Vector2d> places = EmptyPlaces(view, seeds, image->mask, options.spacing);
  places.insert(places.begin(), seeds.begin(), seeds.end());
  std::vector<PatchFeature> found;
  for (const Vector2d& place : places)
  {
    ThrowIfCancelled(stop);
    PatchPlane plane;
    double roughness = 0;
    if (!planes.Fit(place, plane, roughness) ||
      roughness * aligner.Parallax(plane) > options.mostRoughness)
    {
      continue;
    }
    const AlignedPatch patch = aligner.Align(plane);
    if (patch.isGood)
    {
      const cv::Vec3b& color =
        image->color(static_cast<int>(place.y()), static_cast<int>(place.x()));
      found.push_back({ place, patch.plane.disparity, patch.deviation,
        std::max(0.0, 1 - patch.correlation), { color[2], color[1], color[0] } });
    }
  }
  return found;
}

}
