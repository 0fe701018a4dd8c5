// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Choices_h
#define freespace_Choices_h

#include <string>
#include <utility>
#include <vector>

namespace freespace
{

/// What a run chose by itself: of what, and what it chose, in words.
using Choices = std::vector<std::pair<std::string, std::string>>;

}

#endif
