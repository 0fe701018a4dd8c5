// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_DelaunayDisparity_h
#define freespace_DelaunayDisparity_h

#include "Common/DisparityMap.h"
#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Common/View.h"
#include "Disparity/FeatureCloud.h"

namespace freespace
{

/// How a view's features become a disparity map (sections 2 and 2.1).
struct DelaunayDisparityOptions
{
  /// Whether points of other views that stick out of a view's surface are inserted into it.
  bool minimumDisparity = true;

  /// How far a point may stick out, as a fraction of its own disparity (that is, to first order, of
  /// its depth); >= 0. The paper's 0 inserts every point that noise lifts by a hair, which draws
  /// the surface towards the camera.
  double tolerance = 2e-4;

  /// Beyond the paper: whether the triangulation keeps the edges of the view (a constrained Delaunay
  /// triangulation), so that no triangle crosses an edge that the stereo saw. Edges that cross others
  /// are not kept.
  bool keepEdges = false;

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// The disparity map of views[index]: the Delaunay triangulation of the projections of its
/// features, with disparity (1 / depth) linear over each triangle, under the minimum disparity
/// constraint of section 2.1.
///
/// Of all points of the other views the one whose disparity is greatest above the surface is
/// inserted first, then the heights are taken anew, until none is above it by more than the
/// tolerance. Points count only where they are in front of the camera and project into the convex
/// hull of the view's own features. This is Garland and Heckbert's greedy insertion for terrain:
/// each triangle keeps the list of the points in it, and only the triangles that an insertion
/// replaces are looked at again. O(n log n) for n points that are spread over the image.
///
/// Features that are not finite, not in front of the camera, or outside the image are left out. Of
/// points that coincide in the image the nearest counts. The points of the result are where they
/// project, in `imagePoints`: its own features first, in their order, then those inserted, in the
/// order of insertion.
/// Throws Error, naming the view, when fewer than three features can be used or all are collinear.
DisparityMap TriangulateView(
  const std::vector<View>& views, std::size_t index, const DelaunayDisparityOptions& options);

/// The maps of all views, in parallel.
std::vector<DisparityMap> TriangulateViews(const std::vector<View>& views,
  const DelaunayDisparityOptions& options, const ParallelFor& parallelFor = SerialFor,
  const Progress& progress = Progress());

/// The same where the cloud of the views' features is there already; without the constraint any will do.
std::vector<DisparityMap> TriangulateViews(const std::vector<View>& views,
  const FeatureCloud& cloud, const DelaunayDisparityOptions& options,
  const ParallelFor& parallelFor = SerialFor, const Progress& progress = Progress());

}

#endif
