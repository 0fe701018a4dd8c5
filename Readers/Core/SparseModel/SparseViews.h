// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SparseViews_h
#define freespace_SparseViews_h

#include "Common/ParallelFor.h"
#include "Common/View.h"
#include "SparseModel/SparseModel.h"

namespace freespace
{

/// Which observations of a structure-from-motion model are good enough to be features.
struct SparseViewOptions
{
  int minimumTrackLength = 2; ///< images that must see a point
  double maximumError = 4.0;  ///< between an observation and the projection of its point, pixels
  /// Minimum triangulation angle (the largest between two rays to the point), degrees, or the median
  /// over the points if that is less: where all baselines are short, the better half is kept.
  double minimumAngle = 5.0;
  int minimumFeatures = 10; ///< images with fewer inside the frame are left out

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// An image of a model as a view, with the way back to the model. The image points are those that a
/// pinhole camera without distortion would see.
struct SparseView : View
{
  int image = 0;                ///< index in the model
  std::vector<int> point;       ///< per feature: index in the model
  std::vector<int> observation; ///< per feature: index in the image's observations
};

/// Every image of the model as a view of the points that it sees, in the model's order. A point
/// that is not in front of an image's camera, such as one that coincides with its centre, is no
/// feature there and does not count in the track and the angle either.
std::vector<SparseView> ViewsFromModel(const SparseModel& model, const SparseViewOptions& options,
  const ParallelFor& parallelFor = SerialFor);

}

#endif
