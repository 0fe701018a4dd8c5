// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_BundleAdjustment_h
#define freespace_BundleAdjustment_h

#include "Common/Camera.h"
#include "Refinement/EdgeTracks.h"

#include <vector>

namespace freespace
{

/// How cameras are adjusted to edges.
struct BundleAdjustmentOptions
{
  double poseDeviation =
    0.1; ///< of the given cameras in each of their six degrees of freedom, as a
         ///< motion of the scene's image in pixels; > 0
  bool refineFocalLengths = false;     ///< beside the poses
  double focalLengthDeviation = 0.002; ///< of a given focal length, fraction of it; > 0
  int iterations = 10;                 ///< at most, after half as many coarse ones; > 1

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// The result of an adjustment. Residuals are medians of the distances across the edges, pixels.
struct BundleAdjustmentSummary
{
  double residualBefore = 0; ///< the points in their best places, the cameras as given
  double residualAfter = 0;
  double motion = 0; ///< of the points' images from where the given cameras show them, pixels: the
                     ///< median over the cameras of their medians
};

/// Moves cameras and the tracks' points so that the points' images lie on the edges (section 3's third
/// image confirms by this distance). A robust loss limits the influence of wrong matches. A
/// weak prior holds each camera to the given one, and with it the frame of the world, its scale and all that
/// the edges do not determine. One thread, the same result on each run.
///
/// cameras: the initial ones, given or from an earlier adjustment; adjusted in place.
/// lensOf: index of each camera's lens; cameras of one lens share the change of its focal length.
/// A camera that no track of three or more images observes does not move.
BundleAdjustmentSummary AdjustCameras(const std::vector<Camera>& given,
  std::vector<Camera>& cameras, const std::vector<int>& lensOf, std::vector<EdgeTrack>& tracks,
  const BundleAdjustmentOptions& options);

}

#endif
