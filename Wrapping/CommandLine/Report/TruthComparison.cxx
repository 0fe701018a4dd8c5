// SPDX-License-Identifier: BSD-3-Clause
#include "Report/TruthComparison.h"

#include "Common/Error.h"
#include "Common/Median.h"
#include "Data/SurfaceMesh.h"
#include "Execution/SMPParallelFor.h"
#include "Freespace/FeatureHull.h"
#include "Mesh/Distance/SurfaceComparison.h"
#include "Texture/DisparityImage.h"

#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace freespace
{

namespace
{

constexpr double mostRays = 60000;

/// What one ray meets.
struct Hit
{
  Eigen::Vector3d truth;
  Eigen::Vector3d surface; ///< not finite where the ray misses it
  double depth = 0;        ///< of the truth
  double error = 0;        ///< distance along the ray; infinite where it misses the surface
};

int LatticeStep(const std::vector<Camera>& cameras)
{
  double pixels = 0;
  for (const Camera& camera : cameras)
  {
    pixels += double(camera.width) * camera.height;
  }
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(pixels / mostRays))));
}

void AddHits(const TriangleMesh& surface, const TriangleMesh& truth, const Camera& camera, int step,
  const FeatureHull& hull, std::vector<Hit>& hits)
{
  const DisparityImage trueImage = RenderDisparity(truth, camera);
  const DisparityImage image = RenderDisparity(surface, camera);
  for (int row = step / 2; row < camera.height; row += step)
  {
    for (int column = step / 2; column < camera.width; column += step)
    {
      const double trueDisparity = trueImage.At(column, row);
      const double disparity = image.At(column, row);
      if (trueDisparity <= 0)
      {
        continue;
      }
      const Eigen::Vector2d pixel(column + 0.5, row + 0.5);
      const Eigen::Vector3d point = camera.Unproject(pixel, 1 / trueDisparity);
      const int plane = hull.NearestPlane(point);
      if (plane < 0 || hull.Distance(plane, point) > 0)
      {
        continue;
      }
      const double depth = disparity > 0 ? 1 / disparity : std::numeric_limits<double>::infinity();
      hits.push_back({ point, camera.Unproject(pixel, depth), 1 / trueDisparity,
        (depth - 1 / trueDisparity) * camera.Ray(pixel).norm() });
    }
  }
}

double MedianOrNaN(std::vector<double> values)
{
  return MedianOr(std::move(values), std::numeric_limits<double>::quiet_NaN());
}

// The share of points that are nearer to a surface than each limit; points that
// are not finite are ignored.
std::array<double, 3> SharesNear(const std::vector<Eigen::Vector3d>& points,
  const TriangleMesh& mesh, const std::array<double, 3>& limits)
{
  const auto shares = ShareNear(points, mesh, { limits.begin(), limits.end() }, SMPParallelFor);
  return { shares[0], shares[1], shares[2] };
}

void SetRayFigures(const std::vector<Hit>& hits, TruthFigures& figures)
{
  std::vector<double> errors;
  for (const Hit& hit : hits)
  {
    const double error = std::abs(hit.error);
    for (int i = 0; i < 3; ++i)
    {
      figures.within[i] += error < figures.limits[i] ? 1.0 / hits.size() : 0;
    }
    if (std::isfinite(error))
    {
      errors.push_back(error);
      figures.carved += hit.error > figures.limits[2] ? 1.0 / hits.size() : 0;
      figures.bulging += hit.error < -figures.limits[2] ? 1.0 / hits.size() : 0;
    }
  }
  figures.covered = double(errors.size()) / hits.size();
  figures.medianError = MedianOrNaN(errors);
}

}

double TruthFigures::F(int limit) const
{
  return HarmonicMean(this->accuracy[limit], this->completeness[limit]);
}

TruthFigures CompareWithTruth(vtkPolyData* surface, vtkPolyData* truth,
  const std::vector<Camera>& cameras, const std::vector<Eigen::Vector3d>& features)
{
  const TriangleMesh mesh = MeshFromPolyData(surface);
  const TriangleMesh trueMesh = MeshFromPolyData(truth);
  const FeatureHull hull(features, 0);
  const int step = LatticeStep(cameras);
  std::vector<Hit> hits;
  for (const Camera& camera : cameras)
  {
    AddHits(mesh, trueMesh, camera, step, hull, hits);
  }
  if (hits.empty())
  {
    throw Error("No camera sees the true surface within the features' hull: it is not this "
                "scene's, or in other units.");
  }
  std::vector<double> depths;
  std::vector<Eigen::Vector3d> truePoints;
  std::vector<Eigen::Vector3d> points;
  for (const Hit& hit : hits)
  {
    depths.push_back(hit.depth);
    truePoints.push_back(hit.truth);
    points.push_back(hit.surface);
  }
  TruthFigures figures;
  figures.rays = hits.size();
  figures.medianDepth = MedianOrNaN(depths);
  figures.limits = { 0.001 * figures.medianDepth, 0.002 * figures.medianDepth,
    0.005 * figures.medianDepth };
  SetRayFigures(hits, figures);
  figures.accuracy = SharesNear(points, trueMesh, figures.limits);
  figures.completeness = SharesNear(truePoints, mesh, figures.limits);
  return figures;
}

}
