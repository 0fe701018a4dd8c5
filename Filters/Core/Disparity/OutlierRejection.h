// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_OutlierRejection_h
#define freespace_OutlierRejection_h

#include "Common/DisparityMap.h"
#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Common/View.h"

namespace freespace
{

/// When a feature is taken for an outlier.
struct OutlierRejectionOptions
{
  /// Relative noise of the features' depth; > 0. Disparities that differ by a few of it may agree.
  double noise = 5e-4;

  /// So many of a feature's neighbours in its view must agree with it; 0 asks for none.
  int neighbors = 2;

  /// Of so many that are nearest in the image, within two triangles; >= 1.
  int nearest = 6;

  /// Neighbours agree when a surface seen at this angle to its normal or less could join them,
  /// degrees; in [0, 90).
  double steepestAngle = 80.0;

  /// A feature that so many other views see through, and more than see it where it is, is wrong;
  /// 0 asks none. Views that missed an edge see through what is behind it, so that this can cost
  /// features that the minimum disparity constraint needs.
  int seeThroughViews = 0;

  /// A triangle that so many supported features of other views violate, and more than lie on it, is
  /// wrong; a feature that is the deepest corner of wrong ones most of the way round is an outlier.
  /// Finds what was thrown behind the surface, before the constraint buries it. 0 asks none.
  int violatingFeatures = 0;

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// For each view and each of its features whether it stands the tests against outliers. The maps are
/// those of the views, without points from other views.
///
/// The paper (section 2.2) asks for "a requisite amount of support in a local neighborhood of the
/// image". Here the neighbourhood is that of the triangulation, two triangles wide, which adapts to
/// the density of the features. What passes is then held against the other views' free space, and
/// against their features.
/// Features that are in no triangle count as outliers.
std::vector<std::vector<char>> AcceptedFeatures(const std::vector<View>& views,
  const std::vector<DisparityMap>& maps, const OutlierRejectionOptions& options,
  const ParallelFor& parallelFor = SerialFor, const Progress& progress = Progress());

/// The views with their accepted features only. A view that would keep fewer than three keeps all.
std::vector<View> RejectOutliers(const std::vector<View>& views,
  const std::vector<DisparityMap>& maps, const OutlierRejectionOptions& options,
  const ParallelFor& parallelFor = SerialFor, const Progress& progress = Progress());

}

#endif
