// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ProjectionErrors_h
#define freespace_ProjectionErrors_h

#include "SparseModel/SparseModel.h"

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace freespace
{

/// An image whose observations are not where its camera projects their points to.
struct MisprojectedImage
{
  std::string name;
  double error = 0; ///< median over its observations, pixels
};

/// The images of a model of which more than half of the observations lie more than `least` pixels from the
/// projections of their points, and several times as far as in the other images: their cameras do not
/// belong to the points. In the model's order; images with fewer than ten observations
/// tell nothing.
std::vector<MisprojectedImage> FindMisprojectedImages(const SparseModel& model, double least = 4);

std::set<std::string> NamesOf(const std::vector<MisprojectedImage>& images);

/// A sentence, given the number of all images: "2 of 11 images are left out: ... a.jpg (85 pixels), b.jpg (12
/// pixels)".
std::string DescribeMisprojected(const std::vector<MisprojectedImage>& images, std::size_t all);

}

#endif
