// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_Suggestion_h
#define freespace_Suggestion_h

#include <string>
#include <vector>

namespace freespace
{

/// The word that was probably meant: the one with the fewest letters added, left out, changed or swapped, a
/// third of them at most; empty when there is none. Of several the first.
std::string ClosestWord(const std::string& word, const std::vector<std::string>& known);

}

#endif
