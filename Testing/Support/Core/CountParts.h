// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_CountParts_h
#define freespace_CountParts_h

#include <string>

namespace freespace
{

/// How often a part stands in a text, without overlap.
inline std::size_t CountParts(const std::string& text, const std::string& part)
{
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size())
  {
    ++count;
  }
  return count;
}

}

#endif
