// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_EdgeSides_h
#define freespace_EdgeSides_h

#include "Edges/EdgeTokens.h"

#include <cstdint>

namespace freespace
{

/// A side of an edge that is of one grey.
inline EdgeSide SideOf(int grey)
{
  const auto level = static_cast<std::uint8_t>(grey);
  EdgeSide side;
  side.fill({ level, level, level, 0 });
  return side;
}

}

#endif
