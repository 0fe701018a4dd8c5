// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_CenteredObservations_h
#define freespace_CenteredObservations_h

#include "SparseModel/SparseModel.h"

namespace freespace
{

/// Makes a model from a file whose pixels are counted from the middle of images, x right and y
/// down, and which does not tell the size of the images. Bundler's and VisualSFM's files are such.
class CenteredObservations
{
public:
  explicit CenteredObservations(std::size_t images);

  /// An image sees a point, which is not yet finished, at a place.
  void Add(std::size_t image, const Eigen::Vector2d& fromMiddle, SparsePoint& point);

  /// All observations of the point were added.
  void Finish(SparsePoint point);

  /// Places the image in the model with a lens of its own, whose principal point is the middle of
  /// the image. The size is that of the photograph below the folder, else the smallest even one
  /// that holds all observations.
  void Place(std::size_t index, SparseImage image, LensModel lens, std::vector<double> parameters,
    const std::string& folder);

  /// The model of all images that were placed. Throws Error naming the file when an image cannot be
  /// used.
  SparseModel Take(const std::string& file);

private:
  std::vector<std::vector<SparseObservation>> PerImage;
  SparseModel Model;
};

}

#endif
