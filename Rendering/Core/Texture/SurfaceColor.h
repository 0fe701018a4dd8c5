// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SurfaceColor_h
#define freespace_SurfaceColor_h

#include "Common/ParallelFor.h"
#include "Texture/VisibilityMap.h"

#include <optional>

namespace freespace
{

struct SurfaceColorOptions
{
  /// How much the best image of a point outweighs the others: the power to which confidence,
  /// the cosine of incidence and the inverse size of a pixel on the surface are raised.
  double sharpness = 4.0;
  /// Whether differences of exposure between images are compensated.
  bool level = true;
  VisibilityOptions visibility;

  /// Throws Error when a value is out of its range.
  void Check() const;
};

/// The colour of each point of a surface, from all images that see it and for no viewpoint: what a
/// baked texture holds. Because it is a function of the point that fades one image into
/// another, it has no seams, wherever charts are cut.
class SurfaceColor
{
public:
  using Color = Eigen::Vector3d; ///< red, green, blue, 0 to 255

  SurfaceColor(const TriangleMesh& mesh, std::vector<Photograph> photographs,
    const SurfaceColorOptions& options = {}, const ParallelFor& parallelFor = SerialFor);

  /// Nothing where no image sees the point from the side of the (unit) normal.
  std::optional<Color> At(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

  /// Size on the surface of the pixel that sees the point best; infinite where none does.
  double PixelSize(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

  /// The gains of each image's red, green and blue that compensate for its exposure.
  const std::vector<Color>& Gains() const { return this->Levels; }

private:
  double Weight(std::size_t photograph, const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
    Eigen::Vector2d& pixel) const;
  void Level(const TriangleMesh& mesh);

  std::vector<Photograph> Photographs;
  std::vector<VisibilityMap> Maps;
  std::vector<Color> Levels;
  double Sharpness = 4.0;
};

}

#endif
