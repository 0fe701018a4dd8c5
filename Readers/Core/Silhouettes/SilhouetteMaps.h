// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SilhouetteMaps_h
#define freespace_SilhouetteMaps_h

#include "Common/DisparityMap.h"
#include "Common/ParallelFor.h"
#include "Common/Progress.h"
#include "Scene/Scene.h"

#include <vector>

namespace freespace
{

/// The free space that masks show: for each image with a mask that has black parts, a map whose triangles cover those
/// parts, behind all features. Their points are no features (source -1). Named after the image with " (mask)" appended.
///
/// `images` are those of the scene's model, with refined cameras or not. Empty where there are no features. Throws Error
/// naming the file when a mask is damaged, and Aborted.
std::vector<DisparityMap> SilhouetteMaps(const Scene& scene,
  const std::vector<CalibratedImage>& images, const std::vector<EdgeView>& views,
  const ParallelFor& parallelFor, const Progress& progress);

}

#endif
