// SPDX-License-Identifier: BSD-3-Clause
#include "NotNegative.h"

#include <cmath>

namespace freespace
{

CLI::Validator NotNegative()
{
  return CLI::Validator(
    [](const std::string& text)
    {
      double value = 0;
      const bool good =
        CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value >= 0;
      return good ? std::string() : "'" + text + "' is not a number of 0 or more";
    },
    "NUMBER >= 0");
}

}
