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

  /// Minimum number of the nearest neighbours of a feature in its view with a similar disparity; 0
  /// switches the test off.
  int neighbors = 2;

  /// The number of nearest neighbours that are considered, in the image and within two edges of the
  /// triangulation; >= 1.
  int nearest = 6;

  /// The greatest angle of incidence on a surface through two features with similar disparities,
  /// degrees; in [0, 90).
  double steepestAngle = 80.0;

  /// A feature is an outlier if it is in the free space of at least this number of other views, and
  /// of more than have it on their surface; 0 switches the test off. Views that missed an edge see
  /// through it, so that this can remove features that the minimum disparity constraint needs.
  int seeThroughViews = 0;

  /// A triangle is wrong if at least this number of supported features of other views violate the
  /// minimum disparity constraint on it, and more than lie on it; a feature is an outlier if it is
  /// the farthest corner of wrong triangles over most of the angle around it. Finds features far
  /// behind the surface, before the constraint hides them. 0 switches the test off.
  int violatingFeatures = 0;

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// For each view and each of its features whether it passes the tests for outliers. The maps are
/// those of the views, without points from other views.
///
/// The paper (section 2.2) asks for "a requisite amount of support in a local neighborhood of the
/// image". Here the neighbourhood is that of the triangulation, two triangles wide, which adapts to
/// the density of the features. Features that pass are then tested against the other views' free
/// space, and against their features. Features in no triangle are outliers.
std::vector<std::vector<char>> AcceptedFeatures(const std::vector<View>& views,
  const std::vector<DisparityMap>& maps, const OutlierRejectionOptions& options,
  const ParallelFor& parallelFor = SerialFor, const Progress& progress = Progress());

/// The views with their accepted features only. A view with fewer than three of them keeps all
/// features.
std::vector<View> RejectOutliers(const std::vector<View>& views,
  const std::vector<DisparityMap>& maps, const OutlierRejectionOptions& options,
  const ParallelFor& parallelFor = SerialFor, const Progress& progress = Progress());

}

#endif
