// SPDX-License-Identifier: BSD-3-Clause
#include "Tables/TextTable.h"

#include "Files/NameEncoding.h"

#include <algorithm>
#include <sstream>

namespace freespace
{

namespace
{

// Characters of UTF-8, whose further bytes begin with 10.
std::size_t WidthOf(const std::string& text)
{
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(),
    [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

}

std::string TextTable::Text() const
{
  std::vector<std::vector<std::string>> rows = this->Rows;
  std::vector<std::size_t> widths;
  for (auto& row : rows)
  {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t i = 0; i < row.size(); ++i)
    {
      row[i] = Printable(row[i]);
      widths[i] = std::max(widths[i], WidthOf(row[i]));
    }
  }
  std::string text;
  for (const auto& row : rows)
  {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
    {
      const std::string blanks(widths[i] - WidthOf(row[i]), ' ');
      line += i == 0 ? row[i] + blanks : "  " + blanks + row[i];
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string CsvCell(const std::string& word)
{
  if (word.find_first_of(",\"\n\r") == std::string::npos)
  {
    return word;
  }
  std::string quoted = "\"";
  for (char c : word)
  {
    quoted += c == '"' ? "\"\"" : std::string(1, c);
  }
  return quoted + "\"";
}

std::string NumberText(double number, int digits)
{
  std::ostringstream text;
  text.precision(digits);
  text << number;
  return text.str();
}

}
