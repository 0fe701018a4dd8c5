// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ChartPacking_h
#define freespace_ChartPacking_h

#include "Texture/Chart.h"
#include "Texture/TextureAtlas.h"

#include <vector>

namespace freespace
{

/// Packs charts onto shelves, the highest first: sets their place and size and the size of the atlas.
/// Returns whether they fit into the largest atlas.
bool PackCharts(std::vector<Chart>& charts, double texel, const TextureAtlasOptions& options,
  TextureAtlas& atlas);

/// Throws Error when no texel is large enough for the charts to fit. A chart keeps a few texels however
/// large these are, so too many charts never fit.
void CheckChartsFit(
  std::vector<Chart>& charts, const TextureAtlasOptions& options, TextureAtlas& atlas);

}

#endif
