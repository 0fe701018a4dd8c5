// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SharedFeatures_h
#define freespace_SharedFeatures_h

#include "Common/View.h"
#include "Disparity/PointHash.h"

#include <unordered_map>
#include <vector>

namespace freespace
{

/// How many views have a feature at exactly the same place: the views of a structure-from-motion model share its
/// points. O(n).
class SharedFeatures
{
public:
  explicit SharedFeatures(const std::vector<View>& views);

  /// 0 for a point that is no view's feature.
  int ViewsWith(const Eigen::Vector3d& point) const;

private:
  struct Sharers
  {
    int count = 0;
    std::size_t last = 0; // view
  };

  std::unordered_map<Eigen::Vector3d, Sharers, PointHash> Known;
};

}

#endif
