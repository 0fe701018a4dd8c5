// SPDX-License-Identifier: BSD-3-Clause
#include "Text/JsonNode.h"

#include "Common/Error.h"
#include "Common/ParseNumber.h"
#include "Files/NameEncoding.h"
#include "Text/TextSource.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace freespace
{

using Json = nlohmann::json;

namespace
{

// Line and column of a byte, counted from one, of a text.
std::string PlaceOfByte(const std::string& text, std::size_t byte)
{
  const std::string before = text.substr(0, byte > 0 ? byte - 1 : 0);
  const std::size_t lastBreak = before.rfind('\n');
  const std::size_t column = before.size() - (lastBreak == std::string::npos ? 0 : lastBreak + 1);
  return "line " + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) +
    ", column " + std::to_string(column + 1);
}

// The path from one value down to another; empty if it is not below. The documents are not deep.
std::optional<std::string> WayTo(const Json& sought, const Json& from, int levels)
{
  if (&from == &sought)
  {
    return "";
  }
  if (levels == 0 || !from.is_structured())
  {
    return std::nullopt;
  }
  std::size_t index = 0;
  for (const auto& item : from.items())
  {
    if (const auto way = WayTo(sought, item.value(), levels - 1))
    {
      return (from.is_object() ? ", '" + item.key() + "'" : "[" + std::to_string(index) + "]") +
        *way;
    }
    ++index;
  }
  return std::nullopt;
}

}

JsonDocument::JsonDocument(const std::string& file)
  : File(file)
{
  const std::string text = ReadWholeFile(file);
  try
  {
    this->Value = Json::parse(text);
  }
  catch (const Json::parse_error& error)
  {
    throw Error("Cannot read " + file + ": it is not valid JSON, the fault is in " +
      PlaceOfByte(text, error.byte) + ".");
  }
  catch (const Json::exception&)
  {
    throw Error("Cannot read " + file + ": one of its numbers is too large.");
  }
}

std::string JsonDocument::PlaceOf(const Json& value) const
{
  constexpr int levels = 12;
  return this->File + WayTo(value, this->Value, levels).value_or("");
}

void JsonNode::Fail(const std::string& fault) const
{
  throw Error("Cannot read " + this->Document->PlaceOf(*this->Value) + ": " + fault +
    (fault.back() == '.' ? "" : "."));
}

void JsonNode::ExpectObject(const std::vector<std::string>& known) const
{
  if (!this->Value->is_object())
  {
    this->Fail("expected a JSON object");
  }
  for (const auto& item : this->Value->items())
  {
    if (std::find(known.begin(), known.end(), item.key()) == known.end())
    {
      this->Fail("the key '" + item.key() + "' is unknown");
    }
  }
}

JsonNode JsonNode::At(const std::string& key) const
{
  if (!this->Has(key))
  {
    this->Fail("the key '" + key + "' is missing");
  }
  return { (*this->Value)[key], *this->Document };
}

std::vector<JsonNode> JsonNode::Elements() const
{
  if (!this->Value->is_array())
  {
    this->Fail("expected a JSON array");
  }
  std::vector<JsonNode> elements;
  elements.reserve(this->Value->size());
  for (const Json& element : *this->Value)
  {
    elements.emplace_back(element, *this->Document);
  }
  return elements;
}

std::string JsonNode::Text() const
{
  if (!this->Value->is_string() || this->Value->get_ref<const std::string&>().empty())
  {
    this->Fail("expected a non-empty string");
  }
  return NameFromUtf8(this->Value->get<std::string>());
}

double JsonNode::Number() const
{
  if (!this->Value->is_number())
  {
    this->Fail("expected a number");
  }
  return this->Value->get<double>();
}

int JsonNode::Integer() const
{
  const double number = this->Number();
  if (number != std::floor(number) || std::abs(number) > 1e9)
  {
    this->Fail("expected an integer");
  }
  return static_cast<int>(number);
}

bool JsonNode::Truth() const
{
  if (this->Value->is_boolean())
  {
    return this->Value->get<bool>();
  }
  if (this->IsText() && (*this->Value == "true" || *this->Value == "false"))
  {
    return *this->Value == "true";
  }
  return this->NumberOrText() != 0;
}

double JsonNode::NumberOrText() const
{
  if (!this->IsText())
  {
    return this->Number();
  }
  const auto number = ParseNumber<double>(this->Value->get_ref<const std::string&>());
  if (!number)
  {
    this->Fail("expected a number");
  }
  return *number;
}

std::uint64_t JsonNode::Id() const
{
  std::optional<std::uint64_t> id;
  if (this->IsText())
  {
    id = ParseNumber<std::uint64_t>(this->Value->get_ref<const std::string&>());
  }
  else if (this->Value->is_number_unsigned())
  {
    id = this->Value->get<std::uint64_t>();
  }
  if (!id)
  {
    this->Fail("expected a non-negative integer");
  }
  return *id;
}

void JsonNode::Gather(std::vector<double>& numbers, int levels) const
{
  for (const JsonNode& element : this->Elements())
  {
    if (levels > 1 && element.Value->is_array())
    {
      element.Gather(numbers, levels - 1);
    }
    else
    {
      numbers.push_back(element.NumberOrText());
    }
  }
}

std::vector<double> JsonNode::Numbers(std::size_t count) const
{
  std::vector<double> numbers;
  this->Gather(numbers, 2);
  if (numbers.size() != count)
  {
    this->Fail(
      "expected " + std::to_string(count) + " numbers, not " + std::to_string(numbers.size()));
  }
  return numbers;
}

}
