// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_DepthFeatures_h
#define freespace_DepthFeatures_h

#include "Common/View.h"
#include "Depth/DepthMap.h"
#include "Images/CalibratedImage.h"

namespace freespace
{

/// Options of the conversion of depth maps to features.
struct DepthOptions
{
  double scale = 1;     ///< unit of the scene for each unit of the map; > 0
  bool isRange = false; ///< distances from the camera's centre, not along its axis
  double nearest = 0;   ///< depths below are not used, unit of the scene; >= 0
  double farthest = 0;  ///< depths above are not used; 0: no limit
  /// Standard deviation of a depth z: deviation + relativeDeviation z, unit of the scene; >= 0, not both 0.
  double deviation = 0;
  double relativeDeviation = 0.005;
  /// A square of pixels is represented by its corners if the depths between them deviate by no more than this
  /// number of deviations (with corners of smaller blocks on its sides twice as many); >= 0.
  double tolerance = 1;
  int largestBlock = 16; ///< side of the largest block, pixels; 1 makes each pixel a feature

  double DeviationAt(double depth) const
  {
    return this->deviation + this->relativeDeviation * depth;
  }

  /// Throws Error when a field is out of its range.
  void Check() const;
};

/// The features of an image's depth map, row by row. The map has the image's shape, and may be larger or
/// smaller. It is of the image as it is, with the lens's distortion; features stand where the pinhole camera
/// sees them. They have the deviations of their disparities.
/// Pixels without a depth are not features, and squares with such pixels are divided down to single pixels,
/// so that the rims of holes are kept.
///
/// Throws Error where the map has another shape.
View FeaturesOfDepthMap(
  const CalibratedImage& image, const DepthMap& map, const DepthOptions& options);

/// The index of the image that a depth map is of, by the map's file: the one of that name or, where there is
/// just one, of that name without folder or ending. Throws Error naming the file where there is none.
std::size_t ImageOfDepthMap(const std::vector<CalibratedImage>& images, const std::string& file);

}

#endif
