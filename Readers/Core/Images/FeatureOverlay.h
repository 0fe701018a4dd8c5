// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_FeatureOverlay_h
#define freespace_FeatureOverlay_h

#include "Common/View.h"

namespace freespace
{

/// The view's image with its features drawn over it, as in figure 8 of the paper: the image is
/// darkened, the features are coloured by disparity from blue (far) to red (near), the nearest and
/// farthest hundredth sharing the ends of the scale. `chains` are lists of features that are joined by
/// lines; features are dots otherwise. Writes a PNG.
///
/// Throws Error naming the file when the image cannot be read, has another size than the view's
/// camera, or the PNG cannot be written.
void WriteFeatureOverlay(const View& view, const std::vector<std::vector<int>>& chains,
  const std::string& imagesFolder, const std::string& file);

}

#endif
