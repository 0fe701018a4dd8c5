// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_DelaunayDisparity_h
#define freespace_DelaunayDisparity_h

#include "Common/DisparityMap.h"
#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Common/View.h"
#include "Disparity/FeatureCloud.h"
#include "Disparity/PartnerViews.h"

namespace freespace
{

/// How a view's features become a disparity map (sections 2 and 2.1).
struct DelaunayDisparityOptions
{
  /// Whether points of other views that violate the minimum disparity constraint are inserted into
  /// a view's surface (section 2.1).
  bool minimumDisparity = true;

  /// Tolerance of the minimum disparity constraint: by how much a point's disparity may exceed the
  /// surface's, as a fraction of the point's disparity (to first order, of its depth); >= 0. The
  /// paper's 0 also inserts every point that noise alone puts in front of the surface, which biases
  /// the surface towards the camera.
  double tolerance = 2e-4;

  /// Beyond the paper: whether the edges of the view constrain the triangulation (a constrained
  /// Delaunay triangulation), so that no triangle crosses an edge that the stereo found. Edges that
  /// intersect others are skipped.
  bool keepEdges = false;

  /// Beyond the paper: whether an edge of the triangulation is flipped where its two triangles are
  /// badly shaped in space and those of the other diagonal are better. A triangulation that is
  /// Delaunay in the image joins what is close there, over a depth jump, too; this one joins what is
  /// close on the surface. Edges that the stereo found are not flipped. The minimum disparity
  /// constraint holds all the same.
  bool spatialFlips = true;

  /// An edge is flipped where the cotangents of the two angles opposite it, in space, sum to less
  /// than this; <= 0. With 0 the triangulation would be Delaunay's on the surface itself, where the
  /// noise of the features decides more.
  double leastCotangents = -0.25;

  /// The views whose points can be inserted into a view's surface.
  PartnerViewsOptions partners{ 40 };

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// The disparity map of views[index]: the Delaunay triangulation of the projections of its
/// features, with disparity (1 / depth) linear over each triangle, under the minimum disparity
/// constraint of section 2.1.
///
/// The point of another view whose disparity exceeds that of the surface most is inserted first,
/// then the heights above the surface are updated, until no point exceeds it by more than the
/// tolerance. Only points that are in front of the camera and project into the convex hull of the
/// view's own features are considered. This is Garland and Heckbert's greedy insertion for terrain:
/// each triangle keeps the list of the points inside it, and only the triangles that an insertion
/// replaces are updated. O(n log n) for n points that are spread over the image.
///
/// Features that are not finite, not in front of the camera, or outside the image are left out. Of
/// points that coincide in the image, the nearest is used. The result holds the view's own features
/// first, in their order, then the inserted points, in the order of insertion; `imagePoints` are
/// their projections. Throws Error, naming the view, when fewer than three features can be used or
/// all are collinear.
DisparityMap TriangulateView(
  const std::vector<View>& views, std::size_t index, const DelaunayDisparityOptions& options);

/// The maps of all views, in parallel.
std::vector<DisparityMap> TriangulateViews(const std::vector<View>& views,
  const DelaunayDisparityOptions& options, const ParallelFor& parallelFor = SerialFor,
  const Progress& progress = Progress());

/// The same with a given cloud of the views' features, which is not used without the constraint.
std::vector<DisparityMap> TriangulateViews(const std::vector<View>& views,
  const FeatureCloud& cloud, const DelaunayDisparityOptions& options,
  const ParallelFor& parallelFor = SerialFor, const Progress& progress = Progress());

}

#endif
