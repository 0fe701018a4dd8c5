// SPDX-License-Identifier: BSD-3-Clause
#include "Matching/MatcherOptions.h"

#include "Common/Error.h"

namespace freespace
{

void MatcherOptions::Check() const
{
  if (!(this->minimumDisparity >= 0) || !(this->maximumDisparity > this->minimumDisparity))
  {
    throw Error("The least disparity must not be negative and must lie below the greatest.");
  }
  if (!(this->tolerance > 0) || !(this->colorTolerance > 0) || !(this->gradientLimit > 0) ||
    !(this->maximumCost > 0) || this->minimumRun < 1)
  {
    throw Error("The tolerances of edge matching and the least run must be positive.");
  }
  if (!(this->minimumAngle > 0 && this->minimumAngle < 90) ||
    !(this->angleTolerance > 0 && this->angleTolerance < 90))
  {
    throw Error("The angles of edge matching must lie between 0 and 90 degrees.");
  }
}

}
