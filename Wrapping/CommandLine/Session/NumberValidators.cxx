// SPDX-License-Identifier: BSD-3-Clause
#include "Session/NumberValidators.h"

#include <cmath>

namespace freespace
{

namespace
{

bool IsFinite(const std::string& text, double& value)
{
  return CLI::detail::lexical_cast(text, value) && std::isfinite(value);
}

}

CLI::Validator NonNegative()
{
  return CLI::Validator(
    [](const std::string& text)
    {
      double value = 0;
      return IsFinite(text, value) && value >= 0 ? std::string()
                                                 : "'" + text + "' is not a number of 0 or more";
    },
    "NUMBER >= 0");
}

CLI::Validator Positive()
{
  return CLI::Validator(
    [](const std::string& text)
    {
      double value = 0;
      return IsFinite(text, value) && value > 0 ? std::string()
                                                : "'" + text + "' is not a number above 0";
    },
    "NUMBER > 0");
}

}
