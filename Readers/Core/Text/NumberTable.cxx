// SPDX-License-Identifier: BSD-3-Clause
#include "Text/NumberTable.h"

#include "Common/Error.h"
#include "Common/ParseNumber.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

namespace freespace
{

namespace
{

// Whether the first row is a header: it has a letter and does not begin like a number, as "1e3,0,0" or
// "1;2;3e5" do.
bool IsHeading(const std::string& line)
{
  const std::size_t begin = std::min(line.find_first_not_of(" \t+"), line.size());
  const char* end = line.data() + line.size();
  double number = 0;
  return std::from_chars(line.data() + begin, end, number).ec == std::errc::invalid_argument &&
    std::any_of(line.begin(), line.end(), [](unsigned char c) { return std::isalpha(c) != 0; });
}

// The numbers of a row; nothing if it contains anything else.
std::vector<double> ReadRow(std::string line)
{
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream words(line);
  std::vector<double> values;
  for (std::string word; words >> word;)
  {
    const std::optional<double> value = ParseNumber<double>(word);
    if (!value || !std::isfinite(*value))
    {
      return {};
    }
    values.push_back(*value);
  }
  return values;
}

// The next line. Throws Error if it is too long for numbers: /dev/zero is a line without an end.
bool NextLine(std::istream& file, const std::string& fileName, std::string& line)
{
  constexpr std::size_t longest = 1 << 16;
  line.clear();
  for (int c = file.get(); c != '\n'; c = file.get())
  {
    if (c == std::istream::traits_type::eof())
    {
      return !line.empty();
    }
    line += static_cast<char>(c);
    if (line.size() > longest)
    {
      throw Error("'" + fileName + "' is not a table of numbers: one of its lines is too long.");
    }
  }
  return true;
}

}

std::vector<double> ReadNumberTable(std::istream& file, const std::string& fileName,
  std::size_t columns, const std::function<void()>& beforeLine)
{
  std::vector<double> numbers;
  std::string line;
  bool isFirst = true;
  for (int row = 1; NextLine(file, fileName, line); ++row)
  {
    beforeLine();
    if (row == 1 && line.rfind("\xEF\xBB\xBF", 0) == 0) // a byte order mark
    {
      line.erase(0, 3);
    }
    if (line.find_first_not_of(" \t\r") == std::string::npos)
    {
      continue;
    }
    const bool isHeading = isFirst && IsHeading(line);
    isFirst = false;
    if (isHeading)
    {
      continue;
    }
    const std::vector<double> values = ReadRow(line);
    if (values.size() != columns)
    {
      throw Error("'" + fileName + "' has no " + std::to_string(columns) + " numbers in line " +
        std::to_string(row) + ".");
    }
    numbers.insert(numbers.end(), values.begin(), values.end());
  }
  if (isFirst)
  {
    throw Error("'" + fileName + "' is empty: there is no line 1.");
  }
  return numbers;
}

}
