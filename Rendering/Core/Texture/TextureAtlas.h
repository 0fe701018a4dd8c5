// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_TextureAtlas_h
#define freespace_TextureAtlas_h

#include "Common/Progress.h"
#include "Texture/SurfaceColor.h"

namespace freespace
{

struct TextureAtlasOptions
{
  double texel = 0; ///< side of a texel on the surface, an error if it does not fit; 0: the size of
                    ///< the images' pixels on the surface, or larger
  int largest = 8192; ///< side of the atlas, texels
  double memory =
    0; ///< limit for the atlas while it is made, MiB: texels are larger, or an error if their side
       ///< is given; 0: none
  int gutter = 2; ///< texels around each chart that repeat its border
  Eigen::Vector3d unseen = Eigen::Vector3d(178, 178, 178); ///< red, green, blue

  /// Throws Error when a value is out of its range.
  void Check() const;
};

/// A surface with a texture image. Points are duplicated for each chart that contains them.
struct TextureAtlas
{
  std::vector<int> source;                   ///< per point: its index in the mesh
  std::vector<Eigen::Vector2d> coordinates;  ///< per point: 0 to 1 in the image, from its top left
  std::vector<std::array<int, 3>> triangles; ///< in the order of the mesh
  int width = 0;
  int height = 0;
  std::vector<unsigned char> rgb; ///< the top row first
  int charts = 0;
  double texel = 0; ///< side of a texel on the surface, before a chart is projected
};

/// Cuts the surface into charts (see ChartCutter), packs them into an image and colours it. Triangles far
/// from any triangle that an image sees share one texel; unseen texels of a chart take the colours around
/// them.
TextureAtlas BakeTexture(const TriangleMesh& mesh, const SurfaceColor& color,
  const TextureAtlasOptions& options = {}, const ParallelFor& parallelFor = SerialFor,
  const Progress& progress = {});

}

#endif
