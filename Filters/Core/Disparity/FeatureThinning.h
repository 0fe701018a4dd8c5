// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_FeatureThinning_h
#define freespace_FeatureThinning_h

#include "Common/View.h"

namespace freespace
{

/// Which features of a view are merged.
struct FeatureThinningOptions
{
  double spacing =
    3; ///< side of the square cells of the image whose features become one, pixels; >= 0,
       ///< 0 keeps all
  double depthTolerance =
    5e-3; ///< features that differ by more, as a fraction of the depth, stay apart; > 0

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// The view with one feature for each cell of the image and depth: the mean of the cell's features, weighted
/// by the inverse of their variances, where these are known. Features that are closer than noise
/// allows make the steep triangles of a rough surface. An image edge joins the merged features. Features that
/// are not finite or not in front of the camera are left out; the others follow in the order of the first of
/// each cell.
View ThinFeatures(const View& view, const FeatureThinningOptions& options);

}

#endif
