// SPDX-License-Identifier: BSD-3-Clause
#include "Contour/Lattice/ContourOptions.h"

#include "Common/Error.h"
#include "Contour/Lattice/ContourBlock.h"

namespace freespace
{

using Eigen::AlignedBox3d;

void ContourOptions::Check() const
{
  if (this->cells < 2)
  {
    throw Error(
      "The lattice has " + std::to_string(this->cells) + " cells, it must have at least 2.");
  }
  if (!(this->tolerance > 0 && this->tolerance <= 0.5))
  {
    throw Error("The tolerance of the bisection is " + std::to_string(this->tolerance) +
      " cells, it must be above 0 and at most 0.5.");
  }
  if (!(this->clearance > 0 && this->clearance <= 0.25))
  {
    throw Error("The clearance of vertices is " + std::to_string(this->clearance) +
      " cells, it must be above 0 and at most 0.25.");
  }
  if (!(this->sharpAngle > 0 && this->sharpAngle < 180))
  {
    throw Error("The sharp angle is " + std::to_string(this->sharpAngle) +
      " degrees, it must be between 0 and 180.");
  }
  if (!(this->memoryLimit >= 0))
  {
    throw Error(
      "The memory limit is " + std::to_string(this->memoryLimit) + " MiB, it must be 0 or more.");
  }
  if (this->pieces < 1 || this->piece < 0 || this->piece >= this->pieces)
  {
    throw Error("There is no piece " + std::to_string(this->piece) + " of " +
      std::to_string(this->pieces) + ".");
  }
}

bool SinglePrecisionSuffices(const AlignedBox3d& bounds, const ContourOptions& options)
{
  const double largest = bounds.min().cwiseAbs().cwiseMax(bounds.max().cwiseAbs()).maxCoeff();
  const double spacing = bounds.sizes().maxCoeff() / std::max(1, options.cells - 1);
  return largest < std::numeric_limits<float>::max() / 16 &&
    largest * std::numeric_limits<float>::epsilon() < spacing * options.clearance / 16;
}

}
