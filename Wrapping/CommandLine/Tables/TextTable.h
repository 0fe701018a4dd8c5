// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_TextTable_h
#define freespace_TextTable_h

#include <string>
#include <vector>

namespace freespace
{

/// Rows of words in aligned columns: the first column to the left, the others to the right. Control characters are
/// escaped.
class TextTable
{
public:
  void Add(std::vector<std::string> row) { this->Rows.push_back(std::move(row)); }

  /// Each row on a line of its own.
  std::string Text() const;

private:
  std::vector<std::vector<std::string>> Rows;
};

/// A word as a cell of comma-separated values (RFC 4180): quoted where it has to be.
std::string CsvCell(const std::string& word);

/// A number with this many significant digits, without trailing zeros.
std::string NumberText(double number, int digits = 4);

}

#endif
