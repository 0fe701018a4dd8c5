// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SummaryInfo_h
#define freespace_SummaryInfo_h

#include "Summary/ModelSummary.h"

#include <nlohmann/json.hpp>

namespace freespace
{

inline nlohmann::ordered_json SpreadInfo(const Spread& spread)
{
  return { { "least", spread.least }, { "median", spread.median },
    { "greatest", spread.greatest } };
}

/// x_min, x_max, y_min, ...; nothing of an empty box.
inline nlohmann::ordered_json BoundsInfo(const Eigen::AlignedBox3d& box)
{
  nlohmann::ordered_json bounds = nlohmann::ordered_json::array();
  for (int i = 0; i < 3 && !box.isEmpty(); ++i)
  {
    bounds.push_back(box.min()[i]);
    bounds.push_back(box.max()[i]);
  }
  return bounds;
}

}

#endif
