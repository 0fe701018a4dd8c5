// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_TexturePainter_h
#define freespace_TexturePainter_h

#include "Texture/Chart.h"
#include "Texture/SurfaceGeometry.h"
#include "Texture/TextureAtlas.h"

#include <cstddef>
#include <vector>

namespace freespace
{

/// Colours the texels of a packed atlas.
class TexturePainter
{
public:
  /// Keeps references to all four.
  TexturePainter(const SurfaceGeometry& surface, const std::vector<Chart>& packed,
    TextureAtlas& painted, const TextureAtlasOptions& settings);

  /// Where a point is in the atlas, texels.
  Eigen::Vector2d TexelOf(const Chart& chart, const Eigen::Vector3d& point) const;

  /// Colours the texels of a row that the images see. Rows can be painted in parallel.
  void PaintRow(int row, const SurfaceColor& color);

  /// Spreads the colours from texel to texel: through the charts, and into their gutters.
  void Spread();

private:
  void Claim(int index);
  Eigen::Vector3d PointAt(int column, int row, std::size_t at) const;
  void SpreadFrom(std::size_t at, bool intoGutter, std::vector<std::size_t>& next);
  void Set(std::size_t at, const Eigen::Vector3d& color);

  const SurfaceGeometry& Surface;
  const std::vector<Chart>& Charts;
  TextureAtlas& Atlas;
  const TextureAtlasOptions& Options;
  std::vector<int> Owner;      // triangle of each texel, or -1
  std::vector<int> OwnerChart; // and its chart
  std::vector<char> Painted;
};

}

#endif
