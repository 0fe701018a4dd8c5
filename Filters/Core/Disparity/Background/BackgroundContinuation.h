// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BackgroundContinuation_h
#define freespace_BackgroundContinuation_h

#include "Common/DisparityMap.h"
#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Common/View.h"
#include "Disparity/FeatureCloud.h"
#include "Disparity/PartnerViews.h"

namespace freespace
{

/// When a triangle counts as a bridge over a depth jump, and how the background is continued behind
/// it.
struct BackgroundOptions
{
  /// Relative noise of the features' depth; > 0. The other thresholds are small multiples of it.
  double noise = 5e-4;

  /// The least angle of incidence on a bridge, degrees; in [0, 90).
  double grazingAngle = 70.0;

  /// The number of other views that must see through a bridge, close to its near side, to refute
  /// it; >= 1.
  int views = 1;

  /// Points of other views within this distance of the near side of a bridge, pixels, belong to the
  /// occluding edge and are no evidence of matter behind it; >= 0.
  double edgeWidth = 1.0;

  /// The views that can refute a bridge and tell what is behind it.
  PartnerViewsOptions partners{ 16 };

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// Beyond the paper: recovers free space lost at occlusion boundaries.
///
/// Where a near edge occludes a far surface, a Delaunay triangulation joins the two by triangles
/// that are on no surface: bridges. They claim too little free space, and where the bridges of all
/// views overlap, as between two boxes, matter remains that does not exist. A bridge is refuted
/// when it is in the free space of another view close to its near side: if only at a distance, the
/// occluding edge was missed, and the space between it and the near side is not known. The near
/// corners of a refuted bridge are moved back to the background surface, which continues behind the
/// edge:
/// - to the first surface of another view, bridges excluded, that the corner's viewing ray meets
///   behind
/// the middle of the jump;
/// - else to the plane fitted to the far features around, if they are coplanar. A bridge for which
///   both fail, or which would then violate the minimum disparity constraint, is kept.
///
/// Corners that are moved back are appended to the map's points, at the edge's pixel and with the
/// source view -1, so that a map can have two points at one pixel: one to either side of the edge.
/// The given maps are used as they are, in any order of processing; their order is that of the
/// views.
void ContinueBackground(std::vector<DisparityMap>& maps, const std::vector<View>& views,
  const BackgroundOptions& options, const ParallelFor& parallelFor = SerialFor,
  const Progress& progress = Progress());

/// The same with a given cloud of the views' features.
void ContinueBackground(std::vector<DisparityMap>& maps, const FeatureCloud& cloud,
  const BackgroundOptions& options, const ParallelFor& parallelFor = SerialFor,
  const Progress& progress = Progress());

}

#endif
