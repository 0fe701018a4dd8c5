// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_JsonNode_h
#define freespace_JsonNode_h

#include <nlohmann/json.hpp>

#include <memory>
#include <string>
#include <vector>

namespace freespace
{

/// A value of a JSON file. Errors (Error) name the file and the place of the value in it. Lives as long as
/// its document.
class JsonNode
{
public:
  JsonNode(const nlohmann::json& value, const class JsonDocument& document)
    : Value(&value)
    , Document(&document)
  {
  }

  [[noreturn]] void Fail(const std::string& fault) const;

  /// Checks that the object has no other keys than these.
  void ExpectObject(const std::vector<std::string>& known) const;

  bool Has(const std::string& key) const { return this->Value->contains(key); }
  JsonNode At(const std::string& key) const;
  std::vector<JsonNode> Elements() const;
  bool IsText() const { return this->Value->is_string(); }
  bool IsFilled() const
  {
    return !this->IsText() || !this->Value->get_ref<const std::string&>().empty();
  }

  /// A non-empty string, in the encoding of file names.
  std::string Text() const;
  double Number() const;
  int Integer() const;

  /// A boolean, which some programs write as a number or in quotes.
  bool Truth() const;

  /// A number that some programs write in quotes.
  double NumberOrText() const;

  /// An id: an integer from 0 to 2^64 - 1, which may be in quotes.
  std::uint64_t Id() const;

  /// This many numbers from an array or nested arrays; each may be in quotes.
  std::vector<double> Numbers(std::size_t count) const;

private:
  void Gather(std::vector<double>& numbers, int levels) const;

  const nlohmann::json* Value;
  const class JsonDocument* Document;
};

/// A JSON file. Throws Error naming the file and the line where it is not valid.
class JsonDocument
{
public:
  explicit JsonDocument(const std::string& file);

  JsonNode Root() const { return { this->Value, *this }; }

  /// The position of a value, for messages.
  std::string PlaceOf(const nlohmann::json& value) const;

private:
  std::string File;
  nlohmann::json Value;
};

}

#endif
