// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_PatchStereo_h
#define freespace_PatchStereo_h

#include "Common/CancellationFlag.h"
#include "Common/View.h"
#include "Patches/PatchOptions.h"
#include "Patches/ImagePyramids.h"

#include <array>
#include <vector>

namespace freespace
{

/// A feature found by aligning a patch: the centre of a small plane.
struct PatchFeature
{
  Eigen::Vector2d imagePoint;
  double disparity = 0;                   ///< 1 / depth
  double deviation = 0;                   ///< standard deviation of the disparity
  double cost = 0;                        ///< 1 - correlation, 0 (perfect) to 1
  std::array<std::uint8_t, 3> color = {}; ///< red, green, blue
};

/// Looks for features where the edges of a view leave gaps ("more correspondences will only serve to improve the
/// quality", section 2.2): at seeds, which are edges without a match, and on a grid where no feature
/// is near, outside the image's mask. Small planes interpolated from the view's features are aligned to the
/// images of the cluster, see PatchAligner; those that converge become features. In the order of the seeds,
/// then of the grid's rows.
///
/// Throws Error naming the file or view: an image that cannot be read, features that are collinear. Throws Aborted
/// when the flag is set.
std::vector<PatchFeature> FindPatches(const View& view, const std::vector<Eigen::Vector2d>& seeds,
  const CalibratedImage& reference, const std::vector<CalibratedImage>& partners,
  ImagePyramids& images, const PatchOptions& options,
  const CancellationFlag& stop = NeverCancelled);

}

#endif
