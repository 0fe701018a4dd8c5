// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_ParseNumber_h
#define freespace_ParseNumber_h

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace freespace
{

/// Parses a decimal number, which must be the whole text: std::from_chars, which does not depend on
/// the locale and rounds correctly, and which rejects values out of the range of the type. A leading
/// plus sign is allowed. Returns nothing for any other text.
template <typename Value>
std::optional<Value> ParseNumber(std::string_view text)
{
  if (text.size() > 1 && text[0] == '+' && text[1] != '-')
  {
    text.remove_prefix(1);
  }
  Value value{};
  const char* end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  return code == std::errc() && stop == end ? std::optional<Value>(value) : std::nullopt;
}

}

#endif
