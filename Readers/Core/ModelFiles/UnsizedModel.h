// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_UnsizedModel_h
#define freespace_UnsizedModel_h

#include "SparseModel/SparseModel.h"

#include <optional>

namespace freespace
{

class TextSource;

/// Makes a model from a file that does not tell the size of its images, such as Bundler's and VisualSFM's.
///
/// These programs count pixels from the middle of the image. COLMAP writes the same files with pixels
/// counted from a corner: where no observation lies left of or beyond that corner although points do lie
/// to all sides of the optical axes, pixels are taken to be counted from there.
///
/// The principal point is the middle of the image where the file does not give it. Sizes are those of the images where
/// they are found. Else the size is the smallest even one that holds all observations or, where pixels are counted
/// from a corner, the one whose middle the observations and their points put there, to the half pixel.
class UnsizedModel
{
public:
  /// How a file counts pixels.
  struct Pixels
  {
    bool up = false;          ///< y up, not down
    double firstCenter = 0.5; ///< where COLMAP puts the middle of the pixel in the corner
    std::optional<Eigen::Vector2d> origin = {}; ///< where the middle is not, the principal point
  };

  /// A camera model with its parameters, of which the principal point is to be set.
  struct Lens
  {
    LensModel model = LensModel::SimplePinhole;
    std::vector<double> parameters;
  };

  explicit UnsizedModel(const Pixels& pixels)
    : Convention(pixels)
    , In(1, pixels.up ? -1 : 1)
  {
  }

  /// The next image with a lens of its own, and the one where COLMAP counted pixels from a corner. Images
  /// that the file counts but does not place have an empty name; they are left out.
  void Add(SparseImage image, Lens lens, Lens colmaps);

  /// Reads points: position, colour, number of observations, and for each the index of an image, of a key
  /// and the pixel.
  void ReadPoints(TextSource& source, std::uint64_t count);

  /// The model of all images that were placed. Images are sought relative to the folder. Throws Error
  /// naming the file when an image cannot be used.
  SparseModel Take(const std::string& file, const std::string& folder);

private:
  struct Placed
  {
    SparseImage image;
    Lens lens;
    Lens colmaps;
  };

  void ReadObservation(TextSource& source, SparsePoint& point);
  std::vector<Eigen::Vector2d> Projections(const Placed& placed) const;
  bool AreCountedFromCorner() const;
  Eigen::Vector2d HalfSize(const Placed& placed, bool fromCorner, const std::string& folder) const;

  Pixels Convention;
  Eigen::Vector2d In; // signs of the directions from the corner into the image, x right and y down
  std::vector<Placed> Images;
  std::vector<SparsePoint> Points;
};

}

#endif
