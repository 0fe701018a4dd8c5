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

/// The numbers of a table, row by row. Each row has a fixed number of values, separated by commas or blanks;
/// a header line, empty lines and a byte order mark are skipped. `beforeLine` may throw to stop. Throws Error
/// naming the file and the line if a row has anything else, and if the file has no line.
std::vector<double> ReadNumberTable(std::istream& file, const std::string& fileName,
  std::size_t columns, const std::function<void()>& beforeLine);

}

#endif
