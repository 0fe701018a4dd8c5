// SPDX-License-Identifier: BSD-3-Clause
#include "Text/XmlNode.h"

#include "Common/Error.h"
#include "Common/ParseNumber.h"
#include "Text/TextSource.h"

#include <expat.h>

#include <algorithm>
#include <memory>
#include <optional>

namespace freespace
{

namespace
{

// The open elements while the file is read, the innermost last. Elements are complete before they become
// children, so that pointers to them stay valid.
struct Reading
{
  XML_Parser parser;
  std::string file;
  std::vector<XmlNode> open;
  std::string fault;

  void Stop(const char* why)
  {
    this->fault = why;
    XML_StopParser(this->parser, XML_FALSE);
  }
};

// The line that is being read. Expat 2.9 deprecates the shorter name.
std::size_t LineNumber(XML_Parser parser)
{
#if XML_MAJOR_VERSION > 2 || (XML_MAJOR_VERSION == 2 && XML_MINOR_VERSION >= 9)
  return XML_GetCurrentLineNumber64(parser);
#else
  return XML_GetCurrentLineNumber(parser);
#endif
}

void Begin(void* user, const XML_Char* name, const XML_Char** attributes)
{
  constexpr std::size_t most = 64;
  auto& reading = *static_cast<Reading*>(user);
  if (reading.open.size() > most)
  {
    reading.Stop("its elements are nested too deep");
    return;
  }
  XmlNode& node = reading.open.emplace_back();
  node.file = reading.file;
  node.line = LineNumber(reading.parser);
  node.name = name;
  for (; *attributes; attributes += 2)
  {
    node.attributes[attributes[0]] = attributes[1];
  }
}

void End(void* user, const XML_Char*)
{
  auto& reading = *static_cast<Reading*>(user);
  auto& open = reading.open;
  if (!reading.fault.empty())
  {
    return; // the element that ends was not begun
  }
  XmlNode node = std::move(open.back());
  open.pop_back();
  open.back().children.push_back(std::move(node));
}

void Characters(void* user, const XML_Char* text, int length)
{
  static_cast<Reading*>(user)->open.back().text.append(text, static_cast<std::size_t>(length));
}

// Entities could expand a small file without bound.
void BeginDoctype(void* user, const XML_Char*, const XML_Char*, const XML_Char*, int)
{
  static_cast<Reading*>(user)->Stop("it has a document type, which is not supported");
}

}

void XmlNode::Fail(const std::string& fault) const
{
  throw Error(
    "Cannot read " + this->file + ", line " + std::to_string(this->line) + ": " + fault + ".");
}

const XmlNode* XmlNode::Find(const std::string& child) const
{
  for (const XmlNode& node : this->children)
  {
    if (node.name == child)
    {
      return &node;
    }
  }
  return nullptr;
}

const XmlNode& XmlNode::At(const std::string& child) const
{
  const XmlNode* found = this->Find(child);
  if (!found)
  {
    this->Fail("the element '" + this->name + "' has no '" + child + "'");
  }
  return *found;
}

std::string XmlNode::Attribute(const std::string& key) const
{
  const auto found = this->attributes.find(key);
  return found == this->attributes.end() ? "" : found->second;
}

std::vector<double> XmlNode::Numbers(std::size_t count) const
{
  constexpr const char* blanks = " \t\r\n";
  std::vector<double> numbers;
  std::size_t end = 0;
  for (;;)
  {
    const std::size_t begin = this->text.find_first_not_of(blanks, end);
    if (begin == std::string::npos)
    {
      break;
    }
    end = std::min(this->text.find_first_of(blanks, begin), this->text.size());
    const auto number =
      ParseNumber<double>(std::string_view(this->text).substr(begin, end - begin));
    if (!number)
    {
      this->Fail("'" + this->text.substr(begin, std::min<std::size_t>(end - begin, 40)) +
        "' is not a number");
    }
    numbers.push_back(*number);
  }
  if (numbers.size() != count)
  {
    this->Fail("the element '" + this->name + "' should have " + std::to_string(count) +
      " numbers, not " + std::to_string(numbers.size()));
  }
  return numbers;
}

double XmlNode::NumberOr(const std::string& child, double otherwise) const
{
  const XmlNode* found = this->Find(child);
  return found ? found->Numbers(1)[0] : otherwise;
}

XmlNode ReadXmlFile(const std::string& file)
{
  const std::string content = ReadWholeFile(file);
  const std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser(
    XML_ParserCreate(nullptr), XML_ParserFree);
  Reading reading{ parser.get(), file, {}, {} };
  reading.open.emplace_back(); // holds the outermost element
  XML_SetUserData(parser.get(), &reading);
  XML_SetElementHandler(parser.get(), Begin, End);
  XML_SetCharacterDataHandler(parser.get(), Characters);
  XML_SetStartDoctypeDeclHandler(parser.get(), BeginDoctype);
  constexpr std::size_t piece = 1 << 20; // lengths are of type int
  for (std::size_t begin = 0; begin == 0 || begin < content.size(); begin += piece)
  {
    const std::size_t length = std::min(piece, content.size() - begin);
    if (XML_Parse(parser.get(), content.data() + begin, static_cast<int>(length),
          begin + length == content.size()) != XML_STATUS_OK)
    {
      throw Error("Cannot read " + file + ", line " + std::to_string(LineNumber(parser.get())) +
        ": " + (reading.fault.empty() ? "it is not a valid .xml" : reading.fault) + ".");
    }
  }
  return std::move(reading.open.front().children.front());
}

}
