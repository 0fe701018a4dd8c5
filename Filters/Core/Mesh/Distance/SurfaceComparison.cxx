// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Distance/SurfaceComparison.h"

#include "Common/Error.h"
#include "Common/Median.h"
#include "Mesh/Distance/SurfaceSamples.h"
#include "Mesh/Distance/TriangleTree.h"

#include <algorithm>
#include <cmath>

namespace freespace
{

using Eigen::Vector3d;

namespace
{

Vector3d NormalOf(const TriangleMesh& mesh, int triangle)
{
  const auto& [a, b, c] = mesh.triangles[triangle];
  return (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
}

/// Degrees; the arc tangent is exact for small angles, too.
double AngleBetween(const Vector3d& a, const Vector3d& b)
{
  constexpr double degrees = 180 / 3.14159265358979323846;
  return degrees * std::atan2(a.cross(b).norm(), a.dot(b));
}

double Mean(const std::vector<double>& values)
{
  double sum = 0;
  for (double value : values)
  {
    sum += value;
  }
  return values.empty() ? 0 : sum / values.size();
}

/// The points of a surface where each triangle has them once, as samples.
std::vector<SurfaceSample> CornerSamples(const TriangleMesh& mesh)
{
  std::vector<SurfaceSample> samples;
  std::vector<char> isUsed(mesh.points.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (int corner : mesh.triangles[t])
    {
      if (!isUsed[corner] && mesh.points[corner].allFinite())
      {
        samples.push_back({ mesh.points[corner], static_cast<int>(t) });
      }
      isUsed[corner] = 1;
    }
  }
  return samples;
}

std::vector<double> SharesBelow(std::vector<double> distances, const std::vector<double>& limits)
{
  std::sort(distances.begin(), distances.end());
  std::vector<double> shares;
  for (double limit : limits)
  {
    const auto end = std::lower_bound(distances.begin(), distances.end(), limit);
    shares.push_back(distances.empty() ? 0 : double(end - distances.begin()) / distances.size());
  }
  return shares;
}

std::vector<std::size_t> HistogramOf(
  const std::vector<double>& distances, double greatest, int bins)
{
  std::vector<std::size_t> histogram(bins + 1, 0);
  for (double distance : distances)
  {
    ++histogram[static_cast<std::size_t>(std::min(distance / greatest * bins, double(bins)))];
  }
  return histogram;
}

std::vector<double> DistancesAt(const TriangleTree& tree, const std::vector<Vector3d>& points,
  const ParallelFor& parallelFor, const Progress& progress)
{
  std::vector<double> distances;
  const double anyReach = std::numeric_limits<double>::infinity();
  for (const NearestPlace& place : tree.Find(points, anyReach, parallelFor, progress))
  {
    distances.push_back(place.distance);
  }
  return distances;
}

SurfaceDistances DistancesBetween(const TriangleMesh& from, const TriangleMesh& to,
  const SurfaceComparisonOptions& options, const std::vector<double>& limits,
  const ParallelFor& parallelFor, const Progress& progress)
{
  const TriangleTree tree(to, parallelFor);
  progress(0.2);
  const auto samples =
    options.samples > 0 ? SampleSurface(from, options.samples) : CornerSamples(from);
  std::vector<Vector3d> places;
  for (const SurfaceSample& sample : samples)
  {
    places.push_back(sample.point);
  }
  const auto found = tree.Find(
    places, std::numeric_limits<double>::infinity(), parallelFor, progress.Part(0.2, 0.7));
  std::vector<double> distances, squares, angles;
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    distances.push_back(found[i].distance);
    squares.push_back(found[i].distance * found[i].distance);
    angles.push_back(
      AngleBetween(NormalOf(from, samples[i].triangle), NormalOf(to, found[i].triangle)));
  }
  SurfaceDistances figures;
  figures.samples = samples.size();
  figures.mean = Mean(distances);
  figures.rootMeanSquare = std::sqrt(Mean(squares));
  figures.median = Median(distances);
  figures.meanAngle = Mean(angles);
  figures.medianAngle = Median(angles);
  figures.histogram = HistogramOf(distances, limits.back(), options.bins);
  figures.atPoints = DistancesAt(tree, from.points, parallelFor, progress.Part(0.7, 1.0));
  figures.greatest = *std::max_element(distances.begin(), distances.end());
  for (double distance : figures.atPoints)
  {
    figures.greatest =
      std::isfinite(distance) ? std::max(figures.greatest, distance) : figures.greatest;
  }
  figures.within = SharesBelow(std::move(distances), limits);
  return figures;
}

double DiagonalOf(const TriangleMesh& mesh)
{
  Eigen::AlignedBox3d box;
  for (const auto& triangle : mesh.triangles)
  {
    for (int corner : triangle)
    {
      box.extend(mesh.points[corner]);
    }
  }
  return box.diagonal().norm();
}

void CheckArea(const TriangleMesh& mesh, const std::string& name)
{
  for (const auto& triangle : mesh.triangles)
  {
    for (int corner : triangle)
    {
      if (!mesh.points[corner].allFinite())
      {
        throw Error("The " + name + " has a point that is not finite.");
      }
    }
  }
  if (SampleSurface(mesh, 1).empty())
  {
    throw Error("The " + name + " has no triangle with an area.");
  }
}

}

void SurfaceComparisonOptions::Check() const
{
  for (double limit : this->limits)
  {
    if (!(limit > 0) || !std::isfinite(limit))
    {
      throw Error("A distance of the comparison is not positive and finite.");
    }
  }
  if (this->samples < 0)
  {
    throw Error("The number of samples of the comparison is negative.");
  }
  if (this->bins < 1)
  {
    throw Error("The histogram of the comparison has no bin.");
  }
}

double HarmonicMean(double one, double other)
{
  return one + other > 0 ? 2 * one * other / (one + other) : 0;
}

double SurfaceComparison::F(std::size_t limit) const
{
  return HarmonicMean(this->Accuracy(limit), this->Completeness(limit));
}

std::vector<double> ShareNear(const std::vector<Vector3d>& points, const TriangleMesh& mesh,
  const std::vector<double>& limits, const ParallelFor& parallelFor)
{
  std::vector<Vector3d> finite;
  std::copy_if(points.begin(), points.end(), std::back_inserter(finite),
    [](const Vector3d& point) { return point.allFinite(); });
  return SharesBelow(DistancesAt(TriangleTree(mesh, parallelFor), finite, parallelFor, {}), limits);
}

SurfaceComparison CompareSurfaces(const TriangleMesh& surface, const TriangleMesh& reference,
  const SurfaceComparisonOptions& options, const ParallelFor& parallelFor, const Progress& progress)
{
  options.Check();
  CheckArea(surface, "surface");
  CheckArea(reference, "reference");
  SurfaceComparison comparison;
  comparison.limits = options.limits;
  if (comparison.limits.empty())
  {
    const double diagonal = DiagonalOf(reference);
    comparison.limits = { 0.001 * diagonal, 0.002 * diagonal, 0.005 * diagonal };
  }
  std::sort(comparison.limits.begin(), comparison.limits.end());
  comparison.ofSurface = DistancesBetween(
    surface, reference, options, comparison.limits, parallelFor, progress.Part(0.0, 0.5));
  comparison.ofReference = DistancesBetween(
    reference, surface, options, comparison.limits, parallelFor, progress.Part(0.5, 1.0));
  return comparison;
}

}
