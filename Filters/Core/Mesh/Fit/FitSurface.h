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

/// Options of the fit of a surface to features.
struct FitSurfaceOptions
{
  int rounds = 3;              ///< of smoothing normals and moving vertices; >= 0, 0 fits nothing
  NormalFilterOptions normals; ///< what counts as noise of normals
  double waviness = 0.08; ///< standard deviation of the slope of a triangle's edges against its
                          ///< smoothed normal, radians; > 0
  double reach =
    4e-3; ///< features farther from the surface belong to another one, fraction of depth; > 0
  double mostMove = 1;   ///< maximum displacement of a vertex, in median edges; > 0
  bool isSingle = false; ///< points are to be exact in single precision

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// A feature together with its line of sight.
struct SeenFeature
{
  Eigen::Vector3d point;
  Eigen::Vector3d sight; ///< from the camera's centre to the point: its length is the distance
  double deviation = 0;  ///< standard deviation of its depth, as a fraction of it; 0: not known
};

/// Fits the vertices of a surface to the features of all views. A disparity map interpolates the noise of
/// each feature, and the union of many follows the deepest one; here all features are used, and the normals
/// of the surface are smooth except at sharp edges. In each round
/// - the normals of the triangles are smoothed, except across sharp edges, see FilterNormals;
/// - each feature is assigned to the nearest point of the surface that faces it. Its deviation is measured
///   across the surface: that of the depth for a frontal view, that of a pixel for a grazing one. The scale
///   of the deviations is estimated from the residuals, and outliers have less weight (Cauchy);
/// - the vertices are moved by least squares, so that edges are perpendicular to the smoothed normals of
///   their triangles and the surface is close to its features: along the normal where the surface is
///   smooth, in a plane at an edge, freely at a corner.
///
/// The triangles are unchanged. No vertex moves further than `mostMove`, and where the surface would
/// intersect itself, vertices are moved back towards their initial positions until it does not, unless it did
/// before. The same for any number of threads. Throws Aborted when the progress requests it.
void FitSurface(std::vector<Eigen::Vector3d>& points,
  const std::vector<std::array<std::int32_t, 3>>& triangles,
  const std::vector<SeenFeature>& features, const FitSurfaceOptions& options,
  const Progress& progress = {}, const ParallelFor& parallelFor = SerialFor);

}

#endif
