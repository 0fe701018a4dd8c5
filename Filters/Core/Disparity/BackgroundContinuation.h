// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BackgroundContinuation_h
#define freespace_BackgroundContinuation_h

#include "Common/DisparityMap.h"
#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Common/View.h"
#include "Disparity/FeatureCloud.h"

namespace freespace
{

/// When a triangle counts as a bridge over a depth jump, and how the background is continued below it.
struct BackgroundContinuationOptions
{
  /// Relative noise of the features' depth; > 0. Everything else that is compared is a small multiple.
  double noise = 5e-4;

  /// A bridge is seen at this angle to its normal or more, degrees; in [0, 90).
  double grazingAngle = 70.0;

  /// So many other views must see through a bridge, close to its near side, to refute it; >= 1.
  int views = 1;

  /// Points of other views so close to the near side of a bridge, pixels, belong to the edge that it
  /// springs from and do not speak for matter under it; >= 0.
  double edgeWidth = 1.0;

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// Beyond the paper: takes away free space's debt at depth jumps.
///
/// Where a near edge occludes a far surface, a Delaunay triangulation joins the two by triangles that
/// no surface carries: bridges. They claim too little free space, and where the bridges of all views
/// overlap, as between two blocks, matter remains that is not there. A bridge is refuted when another
/// view's free space holds it close to its near side: where it does so further off only, the edge that
/// hides the background was missed, and what is between it and the near side is not known. The near
/// corners are then set back to the surface behind, which goes on
/// below the edge:
/// - where the ray through the corner meets a surface that another view has without a bridge, to that
///   surface (the first behind the middle of the jump);
/// - else to the plane through the far features around, if they lie in one.
/// A bridge that fails both, or that would let a point of any view stick out (the minimum disparity
/// constraint), stays.
///
/// Corners that are set back are added to the map's points, at the edge's pixel and with the source
/// view -1, so that maps may now have two points at one pixel: one to either side of the edge.
/// Looks at the views as they are; the order of the maps is that of the views.
void ContinueBackground(std::vector<DisparityMap>& maps, const std::vector<View>& views,
  const BackgroundContinuationOptions& options, const ParallelFor& parallelFor = SerialFor,
  const Progress& progress = Progress());

/// The same where the cloud of the views' features is there already.
void ContinueBackground(std::vector<DisparityMap>& maps, const FeatureCloud& cloud,
  const BackgroundContinuationOptions& options, const ParallelFor& parallelFor = SerialFor,
  const Progress& progress = Progress());

}

#endif
