// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_FitSurface_h
#define freespace_FitSurface_h

#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Mesh/Fit/NormalFilter.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace freespace
{

/// How a surface is fitted to features.
struct FitSurfaceOptions
{
  int rounds = 2;              ///< of smoothing normals and moving vertices; >= 0, 0 fits nothing
  NormalFilterOptions normals; ///< what counts as noise of normals
  double waviness = 0.05; ///< standard deviation of the slope of a triangle's edges against its
                          ///< smoothed normal, radians; > 0
  double reach =
    4e-3; ///< features further off the surface are of another one, fraction of depth; > 0
  double mostMove = 1;   ///< a vertex moves so far from where it was, in median edges; > 0
  bool isSingle = false; ///< points are to be exact in single precision

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// What a surface is fitted to: a feature as its view sees it.
struct SeenFeature
{
  Eigen::Vector3d point;
  Eigen::Vector3d sight; ///< from the camera's centre to the point: its length is the distance
  double deviation = 0;  ///< standard deviation of its depth, as a fraction of it; 0: not known
};

/// Moves the vertices of a surface to where the features say, as one, that it is. A disparity map
/// interpolates the noise of each feature, and the union of many follows the deepest; here every feature
/// counts, and the normals of the surface are smooth but for sharp edges. In each round
/// - the normals of the triangles are smoothed over all but sharp edges, see FilterNormals;
/// - each feature is given the nearest place of the surface that faces it. Its deviation is across the
///   surface: that of depth where it looks at it straight on, a pixel's where it looks along it. How large
///   deviations are is learned from how far the features are off, and outliers weigh less (Cauchy);
/// - the vertices move so that edges keep to the triangles' smoothed normals and the surface to its
///   features, in the sense of least squares: along the normal where the surface is smooth, in a plane at
///   an edge, freely at a corner.
///
/// Triangles stay as they are. No vertex moves further than `mostMove`, and where the surface would meet
/// itself, vertices go back towards where they were until it does not, if it did not before. The same for
/// any number of threads. Throws Aborted when the progress wants to stop.
void FitSurface(std::vector<Eigen::Vector3d>& points,
  const std::vector<std::array<std::int32_t, 3>>& triangles,
  const std::vector<SeenFeature>& features, const FitSurfaceOptions& options,
  const Progress& progress = {}, const ParallelFor& parallelFor = SerialFor);

}

#endif
