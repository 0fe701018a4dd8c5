// SPDX-License-Identifier: BSD-3-Clause
#include "Text/TextSource.h"

#include "Common/Error.h"
#include "Files/PathChecks.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <utility>

namespace freespace
{

namespace
{

constexpr std::string_view blanks = " \t\r";

std::string_view Trim(std::string_view text)
{
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos)
  {
    return {};
  }
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

}

std::string ReadWholeFile(const std::string& file)
{
  std::ifstream stream;
  if (IsFile(file)) // to open a pipe would wait for its writer
  {
    stream.open(file, std::ios::binary | std::ios::ate);
  }
  if (!stream.is_open())
  {
    throw Error("Cannot read " + file + ": there is no such file or it is not readable.");
  }
  std::string content(static_cast<std::size_t>(stream.tellg()), '\0');
  stream.seekg(0);
  if (!stream.read(content.data(), static_cast<std::streamsize>(content.size())))
  {
    throw Error("Cannot read " + file + ": the disk failed.");
  }
  return content;
}

std::string BeginOfFile(const std::string& file, std::size_t most)
{
  if (!IsFile(file))
  {
    return "";
  }
  std::string begin(most, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(stream.gcount()));
  return begin;
}

TextSource::TextSource(const std::string& file, Lines lines)
  : File(file)
  , Content(ReadWholeFile(file))
  , EndsOfLines(lines)
  , Position(std::string_view(this->Content).substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0)
{
}

void TextSource::Fail(const std::string& fault) const
{
  throw Error(
    "Cannot read " + this->File + ", line " + std::to_string(this->Line) + ": " + fault + ".");
}

bool TextSource::NextLine()
{
  this->Rest = {};
  if (this->Position >= this->Content.size())
  {
    return false;
  }
  const std::size_t end = std::min(this->Content.find('\n', this->Position), this->Content.size());
  this->Rest = Trim(std::string_view(this->Content).substr(this->Position, end - this->Position));
  this->Position = end + 1;
  ++this->Line;
  return true;
}

bool TextSource::NextEntry()
{
  while (this->NextLine())
  {
    if (!this->Rest.empty() && this->Rest.front() != '#')
    {
      return true;
    }
  }
  return false;
}

void TextSource::NeedField(const char* what)
{
  if (this->Rest.empty() && (this->EndsOfLines == Lines::Separate || !this->NextEntry()))
  {
    this->Fail("it ends before " + std::string(what));
  }
}

std::string_view TextSource::Field(const char* what)
{
  this->NeedField(what);
  const std::size_t end = std::min(this->Rest.find_first_of(blanks), this->Rest.size());
  const std::string_view field = this->Rest.substr(0, end);
  this->Rest = Trim(this->Rest.substr(end));
  return field;
}

std::string_view TextSource::Remainder(const char* what)
{
  this->NeedField(what);
  return std::exchange(this->Rest, {});
}

}
