// SPDX-License-Identifier: BSD-3-Clause
#include "Patches/PatchOptions.h"

#include "Common/Error.h"

#include <cmath>

namespace freespace
{

void PatchOptions::Check() const
{
  if (this->radius < 2 || this->radius > 7)
  {
    throw Error("The radius of a patch must be between 2 and 7 pixels.");
  }
  if (this->spacing < 1 || this->seedStep < 1 || this->iterations < 1 || this->leastPartners < 1)
  {
    throw Error("The spacing, iterations and partners of patches must be positive.");
  }
  if (!(this->leastCorrelation > 0 && this->leastCorrelation < 1))
  {
    throw Error("The least correlation of patches must be between 0 and 1.");
  }
  for (const double positive :
    { this->leastContrast, this->mostShift, this->mostDeviation, this->mostRoughness })
  {
    if (!(positive > 0) || !std::isfinite(positive))
    {
      throw Error("The contrast, shift, deviation and roughness of patches must be positive.");
    }
  }
}

}
