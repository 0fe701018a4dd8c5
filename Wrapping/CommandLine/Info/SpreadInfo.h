// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_SpreadInfo_h
#define freespace_SpreadInfo_h

#include "Summary/ModelSummary.h"

#include <nlohmann/json.hpp>

namespace freespace
{

inline nlohmann::ordered_json SpreadInfo(const Spread& spread)
{
  return { { "least", spread.least }, { "median", spread.median },
    { "greatest", spread.greatest } };
}

}

#endif
