// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_FeatureSupport_h
#define freespace_FeatureSupport_h

#include "Common/View.h"

namespace freespace
{

/// When a feature counts as supported by its neighbours in the image (end of section 2.2: "insisting
/// that the recovered features have a requisite amount of support in a local neighborhood").
struct FeatureSupportOptions
{
  double radius = 4.0;      ///< of the neighbourhood, pixels; > 0
  double spacings = 0;      ///< if positive, the radius is this multiple of the mean distance of
                            ///< the view's features instead: 2 covers about 12 of them
  int minimumNeighbors = 0; ///< that agree, the feature itself not counted; 0 keeps all:
                            ///< outliers are then left to OutlierRejection
  double disparityTolerance = 0.01; ///< two features agree when their disparities differ by no more
                                    ///< than this fraction of the greater one

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// For each feature, how many others within the radius agree with its disparity. Features
/// that are not finite or not in front of the camera give no support and count -1.
/// Counts above a thousand may be too low: features that lie upon each other by the million take no
/// longer than others. O(n log n).
std::vector<int> CountSupport(const View& view, const FeatureSupportOptions& options);

}

#endif
