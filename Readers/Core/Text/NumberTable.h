// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_NumberTable_h
#define freespace_NumberTable_h

#include <cstddef>
#include <functional>
#include <istream>
#include <string>
#include <vector>

namespace freespace
{

/// The numbers of a table, row by row: rows of so many numbers, parted by commas or blanks, perhaps below a
/// heading; empty lines and a byte order mark are passed over. `beforeLine` may throw to stop. Throws Error that
/// names the file and the line where that has anything else, and where there is no line.
std::vector<double> ReadNumberTable(std::istream& file, const std::string& fileName,
  std::size_t columns, const std::function<void()>& beforeLine);

}

#endif
