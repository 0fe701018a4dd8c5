// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ModelSummary_h
#define freespace_ModelSummary_h

#include "SparseModel/SparseModel.h"

#include <Eigen/Geometry>

#include <cstdint>

namespace freespace
{

/// Minimum, median and maximum of some numbers; all 0 if there are none.
struct Spread
{
  std::size_t count = 0;
  double least = 0, median = 0, greatest = 0;
};

/// Of the finite ones.
Spread SpreadOf(std::vector<double> values);

/// What a structure-from-motion model holds.
struct ModelSummary
{
  std::size_t cameras = 0, images = 0, points = 0;
  std::size_t observations = 0; ///< of points that the model holds
  Spread trackLengths;          ///< images of each point that has any
  Spread angles;                ///< greatest angle of two rays to each such point, degrees
  Spread errors;                ///< reprojection errors where they are known, pixels
  Eigen::AlignedBox3d centers;  ///< of the images' cameras
  Eigen::AlignedBox3d bounds;   ///< of the points
};

/// Throws Error when an image names a camera that the model does not hold. Of a point that more than 20 images
/// see, 20 of them count for the angle, evenly chosen.
ModelSummary Summarize(const SparseModel& model);

}

#endif
