// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_VisibilityMap_h
#define freespace_VisibilityMap_h

#include "Texture/DisparityImage.h"
#include "Texture/Photograph.h"

#include <optional>

namespace freespace
{

/// Confidence where an image may show the near side of an occlusion in place of the far side. Its
/// colours there are to be replaced, see FillMasked.
constexpr float MaskedConfidence = 0.001f;

struct VisibilityOptions
{
  /// How far behind the surface a point still counts as on it, in sizes of a pixel at its depth.
  double tolerance = 6.0;
  /// What is an occlusion and not a crease: how far the surface jumps or bends back between two
  /// pixels, in sizes of a pixel at its depth. A crease of two faces seen at 18 degrees has 6.
  double jump = 6.0;
  /// Pixels beside an occlusion in which the far side is masked: there the image may show the
  /// near side, because a pixel mixes both and is interpolated with its neighbours.
  double margin = 1.5;
  /// Pixels from an occlusion or the image's border to full confidence.
  double feather = 12.0;
  /// Confidence beside an occlusion, so that an image is used where there is no other.
  double least = 0.02;

  /// Throws Error when a value is out of its range.
  void Check() const;
};

/// What an image shows of a surface: which points it sees, and with which confidence.
struct VisibilityMap
{
  DisparityImage disparity;
  std::vector<float> confidence; ///< per pixel, 0 to 1
  double tolerance = 0;          ///< of disparity

  /// Confidence in the image at a point that it would show at the pixel, 0 where the surface hides
  /// the point or the pixel is outside. Between pixel centres both images are interpolated linearly,
  /// which is exact over a plane; but beside a masked pixel only those of the four count whose
  /// disparity is the point's, so that no point of the far side has the confidence of the near one.
  double At(const Eigen::Vector2d& pixel, double depth) const;
};

/// The second difference of disparity vanishes over a plane however steep, and so tells an occlusion
/// from a slope: it is negative on the near side and positive on the far side. Confidence falls towards
/// both, where an error of the surface would take the one's colour for the other's; it is MaskedConfidence
/// in the far side's margin, `least` in the near side's last pixel, and 0 on the image's border.
VisibilityMap MakeVisibilityMap(
  const TriangleMesh& mesh, const Camera& camera, const VisibilityOptions& options = {});

/// Gives each masked pixel the mean colour of the nearest pixels of its side that are not masked.
void FillMasked(const VisibilityMap& map, Photograph& photograph);

}

#endif
