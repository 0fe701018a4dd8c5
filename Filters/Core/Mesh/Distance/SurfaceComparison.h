// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SurfaceComparison_h
#define freespace_SurfaceComparison_h

#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Mesh/TriangleMesh.h"

#include <array>
#include <cstddef>
#include <vector>

namespace freespace
{

struct SurfaceComparisonOptions
{
  /// Distances at which accuracy, completeness and F are computed, in the surfaces' unit; > 0. Empty: 0.1, 0.2 and
  /// 0.5 % of the diagonal of the reference's bounding box.
  std::vector<double> limits;
  int samples = 500000; ///< of each surface, evenly by area; >= 0; 0: its points alone
  int bins = 50;        ///< of the histogram, from 0 to the greatest limit; >= 1

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// Distances from one surface to the nearest point of another one.
struct SurfaceDistances
{
  std::size_t samples = 0;
  double mean = 0, rootMeanSquare = 0, median = 0; ///< of the samples
  double greatest = 0;                             ///< of samples and points
  std::vector<double> within;         ///< share of the samples that are nearer than each limit
  std::vector<std::size_t> histogram; ///< of the samples; the last bin is beyond the greatest limit
  double meanAngle = 0, medianAngle = 0; ///< between the normals there, degrees, [0, 180]
  std::vector<double> atPoints; ///< of each point of the surface; infinite where it is not finite
};

/// How close two surfaces are.
struct SurfaceComparison
{
  std::vector<double> limits;   ///< ascending
  SurfaceDistances ofSurface;   ///< to the reference: accuracy
  SurfaceDistances ofReference; ///< to the surface: completeness

  double Accuracy(std::size_t limit) const { return this->ofSurface.within[limit]; }
  double Completeness(std::size_t limit) const { return this->ofReference.within[limit]; }

  /// The harmonic mean of both.
  double F(std::size_t limit) const;
};

/// The harmonic mean of two shares; 0 where both are.
double HarmonicMean(double one, double other);

/// The share of points that are nearer to a surface than each limit, of those that are finite.
std::vector<double> ShareNear(const std::vector<Eigen::Vector3d>& points, const TriangleMesh& mesh,
  const std::vector<double>& limits, const ParallelFor& parallelFor = SerialFor);

/// Exact distances, the same for any number of threads. Throws Error when one of the surfaces has no area,
/// Aborted when the progress asks to stop.
SurfaceComparison CompareSurfaces(const TriangleMesh& surface, const TriangleMesh& reference,
  const SurfaceComparisonOptions& options, const ParallelFor& parallelFor = SerialFor,
  const Progress& progress = {});

}

#endif
