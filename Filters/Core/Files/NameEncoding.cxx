// SPDX-License-Identifier: BSD-3-Clause
#include "Files/NameEncoding.h"

#include <cstddef>

namespace freespace
{

namespace
{

constexpr unsigned int firstEscape = 0xEF00;

struct Character
{
  unsigned int code = 0;
  std::size_t length = 0; ///< in bytes; 0 where there is no character of UTF-8
};

Character CharacterAt(const std::string& text, std::size_t at)
{
  const auto byte = [&](std::size_t i) -> unsigned int
  { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0; };
  const unsigned int first = byte(at);
  const std::size_t length = first < 0x80 ? 1
    : first >= 0xC2 && first < 0xE0       ? 2
    : first >= 0xE0 && first < 0xF0       ? 3
    : first >= 0xF0 && first < 0xF5       ? 4
                                          : 0;
  unsigned int code = length < 2 ? first : first & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i)
  {
    if ((byte(at + i) & 0xC0) != 0x80)
    {
      return {};
    }
    code = code << 6 | (byte(at + i) & 0x3F);
  }
  constexpr unsigned int least[] = { 0, 0, 0x80, 0x800, 0x10000 };
  const bool isSurrogate = code >= 0xD800 && code < 0xE000;
  return code < least[length] || isSurrogate || code > 0x10FFFF ? Character{}
                                                                : Character{ code, length };
}

bool IsControl(unsigned int code)
{
  return code < 0x20 || code == 0x7F;
}

bool IsEscape(unsigned int code)
{
  return code >= firstEscape && code < firstEscape + 0x100;
}

void AppendEscaped(std::string& text, unsigned char byte)
{
  const unsigned int code = firstEscape + byte;
  text += static_cast<char>(0xE0 | code >> 12);
  text += static_cast<char>(0x80 | (code >> 6 & 0x3F));
  text += static_cast<char>(0x80 | (code & 0x3F));
}

}

std::string Utf8FromName(const std::string& name)
{
  std::string text;
  for (std::size_t at = 0; at < name.size();)
  {
    const Character c = CharacterAt(name, at);
    // U+FFFE and U+FFFF are no characters of XML.
    if (c.length == 0 || IsControl(c.code) || IsEscape(c.code) || (c.code | 1) == 0xFFFF)
    {
      AppendEscaped(text, static_cast<unsigned char>(name[at]));
      ++at;
      continue;
    }
    text.append(name, at, c.length);
    at += c.length;
  }
  return text;
}

std::string NameFromUtf8(const std::string& text)
{
  std::string name;
  for (std::size_t at = 0; at < text.size();)
  {
    const Character c = CharacterAt(text, at);
    if (c.length == 3 && IsEscape(c.code))
    {
      name += static_cast<char>(c.code - firstEscape);
      at += c.length;
      continue;
    }
    name += text[at++];
  }
  return name;
}

std::size_t Utf8CharacterLength(const std::string& text, std::size_t at)
{
  return CharacterAt(text, at).length;
}

std::string Printable(const std::string& text)
{
  constexpr char digits[] = "0123456789abcdef";
  std::string shown;
  for (const char c : text)
  {
    const auto code = static_cast<unsigned char>(c);
    if (!IsControl(code))
    {
      shown += c;
      continue;
    }
    shown += c == '\n' ? "\\n" : c == '\t' ? "\\t" : c == '\r' ? "\\r" : "\\x";
    if (c != '\n' && c != '\t' && c != '\r')
    {
      shown += digits[code >> 4];
      shown += digits[code & 15];
    }
  }
  return shown;
}

}
