// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_VisibilityMap_h
#define freespace_VisibilityMap_h

#include "DisparityImage.h"

#include <optional>

namespace freespace
{

struct VisibilityOptions
{
  double tolerance =
    0.005;               ///< of disparity: how far behind the surface a point still counts as on it
  double jump = 0.005;   ///< of disparity: what is an occlusion and not relief
  double feather = 12.0; ///< pixels from an occlusion or the image's border to full confidence
  double least =
    0.02; ///< confidence beside an occlusion, so that it is used where there is no other

  /// Throws Error when a value is out of its range.
  void Check() const;
};

/// What a photograph may say about a surface: which points it sees, and how far its word counts.
struct VisibilityMap
{
  DisparityImage disparity;
  std::vector<float> confidence; ///< per pixel, 0 to 1
  double tolerance = 0;

  /// Confidence in the photograph at a point that it would show at the pixel, 0 where the surface
  /// hides the point or the pixel is outside. Between pixel centres both images are interpolated
  /// linearly: at an occlusion that makes the disparity too large for the far side, which is thus
  /// masked.
  double At(const Eigen::Vector2d& pixel, double depth) const;
};

/// The second difference of disparity vanishes over a plane however steep, and so tells an
/// occlusion from a slope: it is negative on the near side and positive on the far side. Confidence
/// falls towards both, where the photograph mixes the two and an error of the surface would take
/// the one's colour for the other's; it is 0 in the far side's last pixel, `least` in the near
/// side's, and 0 on the border.
VisibilityMap MakeVisibilityMap(
  const TriangleMesh& mesh, const Camera& camera, const VisibilityOptions& options = {});

}

#endif
