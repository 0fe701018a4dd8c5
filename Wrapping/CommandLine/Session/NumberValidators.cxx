// SPDX-License-Identifier: BSD-3-Clause
#include "Session/NumberValidators.h"

#include "Common/ParseNumber.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>

namespace freespace
{

namespace
{

std::optional<double> FiniteNumber(const std::string& text)
{
  const std::optional<double> value = ParseNumber<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

}

std::vector<double> NumbersOf(const std::string& text)
{
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();)
  {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    begin = std::min(text.find_first_not_of(' ', begin), end);
    const std::optional<double> number = FiniteNumber(text.substr(begin, end - begin));
    if (!number)
    {
      return {};
    }
    numbers.push_back(*number);
    begin = end + 1;
  }
  return numbers;
}

CLI::Validator NonNegative()
{
  return CLI::Validator(
    [](const std::string& text)
    {
      const double value = FiniteNumber(text).value_or(-1);
      return value >= 0 ? std::string() : "'" + text + "' is not a number of 0 or more";
    },
    "NUMBER >= 0");
}

CLI::Validator Between(double least, double most)
{
  std::ostringstream range;
  range << "NUMBER in [" << least << " - " << most << "]";
  return CLI::Validator(
    [least, most](const std::string& text)
    {
      const double value = FiniteNumber(text).value_or(least - 1);
      return value >= least && value <= most ? std::string()
                                             : "'" + text + "' is not a number in its range";
    },
    range.str());
}

CLI::Validator Positive()
{
  return CLI::Validator(
    [](const std::string& text)
    {
      const double value = FiniteNumber(text).value_or(-1);
      return value > 0 ? std::string() : "'" + text + "' is not a number above 0";
    },
    "NUMBER > 0");
}

CLI::Validator WholeNumber(int least, int most)
{
  const std::string range = std::to_string(least) + " to " + std::to_string(most);
  return CLI::Validator(
    [least, most, range](const std::string& text)
    {
      const std::optional<int> value = ParseNumber<int>(text);
      return value && *value >= least && *value <= most
        ? std::string()
        : "'" + text + "' is not a whole number from " + range;
    },
    "INT in [" + std::to_string(least) + " - " + std::to_string(most) + "]");
}

}
