// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_EpipolarRays_h
#define freespace_EpipolarRays_h

#include "Edges/EdgeTokens.h"
#include "Epipolar/EpipolarPair.h"

#include <vector>

namespace freespace
{

/// The rays of several tokens in a pair's rectified frame, as a structure of arrays for vectorization.
class EpipolarRays
{
public:
  std::vector<double> u, v, scale;        ///< see EpipolarPair::Ray
  std::vector<double> tangentU, tangentV; ///< of the edge, unit length, rectified
  std::vector<double> acrossU, acrossV;   ///< way of the rectified pixel when the token moves one
                                          ///< pixel along its normal

  EpipolarPair::Ray At(int k) const { return { this->u[k], this->v[k], this->scale[k] }; }

  /// Of tokens of the camera whose homography (EpipolarPair) this is. Meaningless where the scale
  /// is not positive.
  void Compute(const Eigen::Matrix3d& homography, const EdgeToken* tokens, int count);

private:
  std::vector<double> X, Y; // of what is transformed
};

}

#endif
