// SPDX-License-Identifier: BSD-3-Clause
#include "Disparity/Outliers/SharedFeatures.h"

namespace freespace
{

SharedFeatures::SharedFeatures(const std::vector<View>& views)
{
  for (std::size_t v = 0; v < views.size(); ++v)
  {
    for (const Eigen::Vector3d& point : views[v].points)
    {
      if (!point.allFinite())
      {
        continue;
      }
      Sharers& sharers = this->Known[point];
      if (sharers.count == 0 || sharers.last != v)
      {
        ++sharers.count;
        sharers.last = v;
      }
    }
  }
}

int SharedFeatures::ViewsWith(const Eigen::Vector3d& point) const
{
  const auto known = this->Known.find(point);
  return known == this->Known.end() ? 0 : known->second.count;
}

}
