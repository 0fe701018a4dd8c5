// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/Outliers/OutlierOptions.h"

#include "Common/Error.h"

#include <cmath>
#include <string>

namespace freespace
{

void OutlierOptions::Check() const
{
  if (!(this->noise > 0) || !std::isfinite(this->noise))
  {
    throw Error("The relative noise of the features' depth must be positive.");
  }
  if (this->support < 0 || this->nearest < 1 || this->seeThroughViews < 0 ||
    this->violatingFeatures < 0)
  {
    throw Error("The numbers of neighbours, views and features that test for outliers are out of "
                "range.");
  }
  if (this->sharingViews < 0 || this->sharingViews == 1)
  {
    throw Error("Features that need no support are those of two views at least.");
  }
  if (!(this->radius >= 0) || !std::isfinite(this->radius) || !(this->tolerance >= 0))
  {
    throw Error("The radius of a feature's neighbourhood and its tolerance cannot be negative.");
  }
  if (this->radius == 0 && this->support > this->nearest)
  {
    throw Error("A feature cannot have the support of " + std::to_string(this->support) +
      " of its " + std::to_string(this->nearest) + " nearest neighbours.");
  }
  if (!(this->steepestAngle >= 0 && this->steepestAngle < 90))
  {
    throw Error("The steepest angle between neighbours must be in [0, 90) degrees.");
  }
}

}
