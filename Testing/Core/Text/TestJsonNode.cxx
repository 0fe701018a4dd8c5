// SPDX-License-Identifier: BSD-3-Clause
#include "Text/JsonNode.h"

#include "Common/Error.h"
#include "Support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <functional>

using namespace freespace;

namespace
{

// The message of the Error that an action on a document of this text throws, without the file's name.
std::string JsonErrorOf(const std::string& text, const std::function<void(const JsonNode&)>& action)
{
  const TemporaryFolder folder;
  const std::string file = folder.Write("a.json", text), begin = "Cannot read " + file;
  try
  {
    const JsonDocument document(file);
    action(document.Root());
  }
  catch (const Error& error)
  {
    const std::string message = error.what();
    EXPECT_EQ(message.rfind(begin, 0), 0u) << message;
    return message.substr(std::min(begin.size(), message.size()));
  }
  return "no error";
}

void Nothing(const JsonNode&) {}

}

TEST(JsonNode, ReadsEachKindOfValue)
{
  const TemporaryFolder folder;
  const JsonDocument document(folder.Write("a.json",
    R"({ "text": "a", "number": 1.5, "integer": -3, "yes": true, "no": "false", "one": 1,
         "quoted": "2.25", "id": 18446744073709551615, "quotedId": "7",
         "list": [1, "2", 3], "matrix": [[1, 2], [3, 4]], "empty": "" })"));
  const JsonNode root = document.Root();
  EXPECT_EQ(root.At("text").Text(), "a");
  EXPECT_EQ(root.At("number").Number(), 1.5);
  EXPECT_EQ(root.At("integer").Integer(), -3);
  EXPECT_TRUE(root.At("yes").Truth());
  EXPECT_FALSE(root.At("no").Truth());
  EXPECT_TRUE(root.At("one").Truth());
  EXPECT_EQ(root.At("quoted").NumberOrText(), 2.25);
  EXPECT_EQ(root.At("id").Id(), 18446744073709551615u);
  EXPECT_EQ(root.At("quotedId").Id(), 7u);
  EXPECT_EQ(root.At("list").Numbers(3), (std::vector<double>{ 1, 2, 3 }));
  EXPECT_EQ(root.At("matrix").Numbers(4), (std::vector<double>{ 1, 2, 3, 4 }));
  EXPECT_EQ(root.At("list").Elements().size(), 3u);
  EXPECT_TRUE(root.Has("empty"));
  EXPECT_FALSE(root.At("empty").IsFilled());
  EXPECT_TRUE(root.At("integer").IsFilled());
  EXPECT_FALSE(root.Has("absent"));
}

TEST(JsonNode, ErrorsSayWhatWasExpectedAndWhere)
{
  const auto at = [](const char* key) { return [key](const JsonNode& root) { root.At(key); }; };
  EXPECT_EQ(JsonErrorOf("{}", at("a")), ": the key 'a' is missing.");
  EXPECT_EQ(JsonErrorOf("[]", [](const JsonNode& root) { root.ExpectObject({}); }),
    ": expected a JSON object.");
  EXPECT_EQ(
    JsonErrorOf(R"({ "a": 1, "b": 2 })", [](const JsonNode& root) { root.ExpectObject({ "a" }); }),
    ": the key 'b' is unknown.");
  const std::string nested = R"({ "a": [ { "b": 1.5 } ] })";
  const auto b = [](const JsonNode& root) { return root.At("a").Elements()[0].At("b"); };
  for (const auto& [expected, action] :
    std::vector<std::pair<std::string, std::function<void(const JsonNode&)>>>{
      { "expected a non-empty string", [&](const JsonNode& root) { (void)b(root).Text(); } },
      { "expected an integer", [&](const JsonNode& root) { (void)b(root).Integer(); } },
      { "expected a non-negative integer", [&](const JsonNode& root) { (void)b(root).Id(); } },
      { "expected a JSON array", [&](const JsonNode& root) { (void)b(root).Elements(); } } })
  {
    const std::string message = JsonErrorOf(nested, action);
    EXPECT_NE(message.find(expected), std::string::npos) << message;
    EXPECT_NE(message.find('a'), std::string::npos) << "the way to the value: " << message;
    EXPECT_NE(message.find('b'), std::string::npos) << message;
  }
  EXPECT_NE(JsonErrorOf("[1, 2]", [](const JsonNode& root) { (void)root.Numbers(3); })
              .find("expected 3 numbers, not 2"),
    std::string::npos);
  EXPECT_NE(JsonErrorOf(R"(["x"])", [](const JsonNode& root) { (void)root.Numbers(1); })
              .find("expected a number"),
    std::string::npos);
}

TEST(JsonNode, TextThatIsNotJsonNamesLineAndColumn)
{
  EXPECT_EQ(JsonErrorOf("{\n  \"a\": }\n", Nothing),
    ": it is not valid JSON, the fault is in line 2, column 8.");
  EXPECT_NE(JsonErrorOf("", Nothing).find("not valid JSON"), std::string::npos);
  EXPECT_EQ(JsonErrorOf("[1e999]", Nothing), ": one of its numbers is too large.");
  EXPECT_THROW(JsonDocument("/no/such/file.json"), Error);
}
