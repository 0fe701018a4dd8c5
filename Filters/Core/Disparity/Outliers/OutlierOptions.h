// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_OutlierOptions_h
#define freespace_OutlierOptions_h

namespace freespace
{

/// When a feature is taken for an outlier. The paper (end of section 2.2) insists on "a requisite amount of support in
/// a local neighborhood of the image"; the tests against other views are beyond it.
struct OutlierOptions
{
  /// Minimum number of features in the neighbourhood with a similar disparity; >= 0, 0 switches the test off.
  int support = 2;

  /// A feature that at least this number of views have at exactly the same place, as the views of a
  /// structure-from-motion model have, needs no support: each of them has confirmed it. 0: all need it; otherwise >= 2.
  int sharingViews = 3;

  /// The neighbourhood. 0: the `nearest` features within two edges of the triangulation, which adapts to the density of
  /// the features and to depth jumps. Otherwise all features within this multiple of the mean distance between the features
  /// of the view: 2 has about 12 of them. For isolated points; >= 0.
  double radius = 0;

  /// The number of nearest features that are considered without a radius; >= 1, not below `support`.
  int nearest = 6;

  /// Features within the radius are similar if their disparities differ by at most this fraction of the greater
  /// one; >= 0. Without a radius the noise and the disparities of the view tell.
  double tolerance = 0.05;

  /// Relative noise of the features' depth; > 0. Disparities that differ by a few of it may agree.
  double noise = 5e-4;

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

  /// Whether the features of other views are asked.
  bool AsksOthers() const { return this->seeThroughViews > 0 || this->violatingFeatures > 0; }

  /// Whether there is any test.
  bool IsOn() const { return this->support > 0 || this->AsksOthers(); }

  /// Throws Error when a field is out of its range.
  void Check() const;
};

}

#endif
