// SPDX-License-Identifier: BSD-3-Clause
#include "Report/Page/Html.h"

#include "Common/Error.h"
#include "Files/NameEncoding.h"

#include <set>

namespace freespace
{

namespace
{

std::string Entity(const std::string& character)
{
  const unsigned char byte = static_cast<unsigned char>(character[0]);
  switch (byte)
  {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    case '\t':
    case '\n':
      return character;
    default:
      return byte < 0x20 || byte == 0x7f ? "\xef\xbf\xbd" : character;
  }
}

}

std::string EscapeHtml(const std::string& text)
{
  std::string escaped;
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t length = Utf8CharacterLength(text, at);
    escaped += length == 0 ? "\xef\xbf\xbd" : Entity(text.substr(at, length));
    at += length == 0 ? 1 : length;
  }
  return escaped;
}

std::string FillTemplate(const std::string& text, const std::map<std::string, std::string>& parts)
{
  std::string filled;
  std::set<std::string> used;
  std::size_t at = 0;
  for (std::size_t open = 0; (open = text.find("{{", at)) != std::string::npos;)
  {
    const std::size_t close = text.find("}}", open);
    const std::string name = text.substr(open + 2, close - open - 2);
    const auto part = parts.find(name);
    if (close == std::string::npos || part == parts.end())
    {
      throw Error(
        "The template of the page wants a part '" + name.substr(0, 40) + "' that there is not.");
    }
    filled += text.substr(at, open - at) + part->second;
    used.insert(name);
    at = close + 2;
  }
  for (const auto& part : parts)
  {
    if (used.count(part.first) == 0)
    {
      throw Error("The template of the page has no place for '" + part.first + "'.");
    }
  }
  return filled + text.substr(at);
}

}
